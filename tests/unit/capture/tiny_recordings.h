#pragma once

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "core/scan/open_source.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {

inline constexpr int kTinyWidth = 64;
inline constexpr int kTinyHeight = 48;

inline cv::Mat tinyDepth(int value, cv::Size size = {kTinyWidth, kTinyHeight}) {
  return cv::Mat(size, CV_16UC1, cv::Scalar(value));
}

inline cv::Mat tinyColor(int blue, cv::Size size = {kTinyWidth, kTinyHeight}) {
  return cv::Mat(size, CV_8UC3, cv::Scalar(blue, 20, 30));
}

inline void writeImage(const std::filesystem::path& path, const cv::Mat& image) {
  std::filesystem::create_directories(path.parent_path());
  ASSERT_TRUE(cv::imwrite(path.string(), image)) << path;
}

inline std::string numbered(const char* format, int number) {
  char text[64];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

/// Truncates a file to this share of its size.
inline void truncate(const std::filesystem::path& path, double part) {
  const auto size = static_cast<double>(std::filesystem::file_size(path));
  std::filesystem::resize_file(path, static_cast<std::uintmax_t>(size * part));
}

/// color/ and depth/ with frames `first` ... `first + count - 1`; depth 1000 + number, blue = number.
inline void writeNumberedFolder(const std::filesystem::path& folder, int first, int count) {
  for (int i = first; i < first + count; ++i) {
    writeImage(folder / "color" / numbered("%06d.png", i), tinyColor(i));
    writeImage(folder / "depth" / numbered("%06d.png", i), tinyDepth(1000 + i));
  }
}

/// 7-Scenes with poses that move along x by 0.01 m a frame.
inline void writeSevenScenes(const std::filesystem::path& folder, int first, int count) {
  for (int i = first; i < first + count; ++i) {
    writeImage(folder / numbered("frame-%06d.color.png", i), tinyColor(i));
    writeImage(folder / numbered("frame-%06d.depth.png", i), tinyDepth(1000 + i));
    std::ofstream(folder / numbered("frame-%06d.pose.txt", i))
        << "1 0 0 " << 0.01 * i << "\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  }
}

/// All results of a source until its end.
inline std::vector<FrameRead> readAll(FrameSource& source) {
  std::vector<FrameRead> reads;
  while (true) {
    FrameRead read = source.next();
    if (read.status == FrameRead::Status::end) {
      return reads;
    }
    reads.push_back(std::move(read));
    if (reads.back().status == FrameRead::Status::failed || reads.size() > 5000) {
      return reads;
    }
  }
}

inline std::string openError(const std::filesystem::path& path, const SourceOptions& options = {}) {
  const auto source = openSource(path.string(), options);
  return source ? "(opened)" : source.error().message();
}

}  // namespace scantrove::test
