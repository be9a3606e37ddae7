#include "core/scan/key_frame_files.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "core/exchange/atomic_file.h"
#include "core/image/image_file.h"
#include "core/image/png_encoder.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

/// The extension of a file that is kept as it is, in small letters; empty: of none such.
std::string extensionKept(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension == ".jpg" || extension == ".jpeg" || extension == ".png" ? extension : "";
}

std::string bytesOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Result<void> writeColor(const fs::path& session_folder, const RgbdFrame& frame, SavedKeyFrame& key) {
  if (frame.color.empty()) return {};
  const std::string kept = extensionKept(frame.color_file);
  std::string bytes = kept.empty() ? "" : bytesOf(frame.color_file);
  const std::string extension = bytes.empty() ? ".png" : kept;
  if (bytes.empty()) bytes = encodePng(frame.color);
  key.color_file = fs::path("keyframes") / fmt::format("{:06}.color{}", key.frame, extension);
  return writeFileAtomically(session_folder / key.color_file, bytes, Durability::process);
}

/// As a frame that cannot be used says it.
Result<cv::Mat> orLeftOut(Result<cv::Mat> image, const fs::path& file) {
  if (image) return image;
  return fail("The key frame image " + file.string() + " is missing or damaged.",
              "That frame is left out; the rest can be used.");
}

}  // namespace

Result<SavedKeyFrame> writeKeyFrame(const fs::path& session_folder, int number, const RgbdFrame& frame) {
  SavedKeyFrame key;
  key.frame = number;
  key.metres_per_unit = frame.metres_per_unit;
  key.color_camera = frame.color_camera;
  key.color_width = frame.color.cols;
  key.color_height = frame.color.rows;
  SCANTROVE_TRY(writeColor(session_folder, frame, key));
  key.depth_file = fs::path("keyframes") / fmt::format("{:06}.depth.png", number);
  SCANTROVE_TRY(
      writeFileAtomically(session_folder / key.depth_file, encodePng(frame.depth), Durability::process));
  return key;
}

Result<RgbdFrame> readKeyFrame(const fs::path& session_folder, const SavedKeyFrame& key_frame,
                               const SavedFrame& frame) {
  RgbdFrame read;
  read.index = frame.source_index;
  read.timestamp_s = frame.time_s;
  read.metres_per_unit = key_frame.metres_per_unit;
  read.color_camera = key_frame.color_camera;
  const fs::path depth_file = session_folder / key_frame.depth_file;
  SCANTROVE_TRY(moveInto(read.depth, orLeftOut(readGreyImage(depth_file), depth_file)));
  if (read.depth.type() != CV_16UC1) {
    return fail("The key frame image " + depth_file.string() + " is no 16-bit depth image.",
                "That frame is left out; the rest can be used.");
  }
  if (!key_frame.color_file.empty()) {
    read.color_file = session_folder / key_frame.color_file;
    SCANTROVE_TRY(moveInto(read.color, orLeftOut(readColorImage(read.color_file), read.color_file)));
  }
  return read;
}

}  // namespace scantrove
