#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/support/temporary_folder.h"

namespace scantrove::test {

/// Depth in metres along the ray (u, v, 1): a room corner (two walls and the floor) with a ball in front.
inline float depthOfCorner(float u, float v) {
  float z = 1.6F / (1.0F + 0.3F * u + 0.2F * v);
  if (v > 0.05F) z = std::min(z, 0.35F / v);
  if (u < 0.1F) z = std::min(z, 0.45F / (0.2F - u));
  // |z (u, v, 1) - (0, 0, 1.2)| = 0.2
  const float a = u * u + v * v + 1.0F;
  const float under_root = 1.2F * 1.2F - a * (1.2F * 1.2F - 0.04F);
  return under_root > 0 ? std::min(z, (1.2F - std::sqrt(under_root)) / a) : z;
}

/// Writes a small 7-Scenes recording of that corner from a camera at rest.
inline void writeRecording(const std::filesystem::path& folder, int frames) {
  std::filesystem::create_directories(folder);
  const int width = 320, height = 240;
  const float f = 292.5F;
  cv::Mat1w depth(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float u = (static_cast<float>(x) - 160.0F) / f;
      const float v = (static_cast<float>(y) - 120.0F) / f;
      depth(y, x) = static_cast<std::uint16_t>(std::lround(1000.0F * depthOfCorner(u, v)));
    }
  }
  const cv::Mat color(height, width, CV_8UC3, cv::Scalar(90, 120, 150));
  for (int i = 0; i < frames; ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "frame-%06d.", i);
    cv::imwrite((folder / (name + std::string("color.png"))).string(), color);
    cv::imwrite((folder / (name + std::string("depth.png"))).string(), depth);
    std::ofstream(folder / (name + std::string("pose.txt"))) << "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  }
  std::ofstream(folder / "camera-intrinsics.txt") << "292.5 0 160\n0 292.5 120\n0 0 1\n";
}

/// Cuts the file to half its size.
inline void truncate(const std::filesystem::path& path) {
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
}

}  // namespace scantrove::test
