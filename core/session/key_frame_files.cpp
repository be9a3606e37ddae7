#include "core/session/key_frame_files.h"

#include <spdlog/fmt/fmt.h>

#include <cstdint>
#include <string>
#include <utility>

#include "core/base/checksum.h"
#include "core/base/regular_file.h"
#include "core/capture/usable_depth.h"
#include "core/exchange/atomic_file.h"
#include "core/image/color_bytes.h"
#include "core/image/image_file.h"
#include "core/image/image_header.h"
#include "core/image/png_encoder.h"
#include "core/session/session_store.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

/// The bytes of a JPEG or PNG without its orientation; empty: another format.
std::string readStored(const fs::path& file) {
  if (file.empty()) return {};
  Result<std::string> bytes = readFile(file);
  if (!bytes) return {};
  const auto format = imageFormat({reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()});
  const bool is_kept = format == ImageFormat::jpeg || format == ImageFormat::png;
  return is_kept ? withoutOrientation(std::move(*bytes)) : std::string();
}

std::uint32_t crcOfImage(const std::string& bytes) { return crc32Of({bytes.data(), bytes.size()}); }

std::string stemOf(int number) { return fmt::format("{:06}", number); }

Result<void> writeColor(SessionStore& session, const RgbdFrame& frame, SavedKeyFrame& key) {
  if (frame.color.empty()) return {};
  std::string bytes = readStored(frame.color_file);
  if (bytes.empty()) bytes = encodePng(frame.color);
  const std::string extension = bytes.starts_with('\xFF') ? ".jpg" : ".png";
  key.color_checksum = crcOfImage(bytes);
  SCANTROVE_TRY(moveInto(key.color_file, session.claimImage(stemOf(key.frame), ".color" + extension)));
  return writeFileAtomically(session.folder() / key.color_file, bytes, Durability::process);
}

Result<void> writeDepth(SessionStore& session, const RgbdFrame& frame, SavedKeyFrame& key) {
  const std::string bytes = encodePng(usableDepth(frame));
  key.depth_checksum = crcOfImage(bytes);
  SCANTROVE_TRY(moveInto(key.depth_file, session.claimImage(stemOf(key.frame), ".depth.png")));
  return writeFileAtomically(session.folder() / key.depth_file, bytes, Durability::process);
}

/// Error: the file cannot be read, or differs from the stored one.
Result<void> checkFile(const fs::path& file, const std::optional<std::uint32_t>& checksum) {
  if (!checksum) return {};
  const Result<std::string> bytes = readFile(file);
  if (bytes && crcOfImage(*bytes) == *checksum) return {};
  return fail("The key frame image " + file.string() + " is missing, or not the one that was written.",
              "That frame is left out; the rest can be used.");
}

/// The error for an unusable frame.
Result<cv::Mat> orLeftOut(Result<cv::Mat> image, const fs::path& file) {
  if (image) return image;
  return fail("The key frame image " + file.string() + " is missing or damaged.",
              "That frame is left out; the rest can be used.");
}

}  // namespace

Result<SavedKeyFrame> writeKeyFrame(SessionStore& session, int number, const RgbdFrame& frame) {
  SavedKeyFrame key;
  key.frame = number;
  key.meters_per_unit = frame.meters_per_unit;
  key.color_camera = frame.color_camera;
  key.color_width = frame.color.cols;
  key.color_height = frame.color.rows;
  SCANTROVE_TRY(writeColor(session, frame, key));
  SCANTROVE_TRY(writeDepth(session, frame, key));
  return key;
}

Result<RgbdFrame> readKeyFrame(const fs::path& session_folder, const SavedKeyFrame& key_frame,
                               const SavedFrame& frame) {
  RgbdFrame read;
  read.index = frame.source_index;
  read.timestamp_s = frame.time_s;
  read.meters_per_unit = key_frame.meters_per_unit;
  read.color_camera = key_frame.color_camera;
  read.intrinsics = frame.intrinsics;
  const fs::path depth_file = session_folder / key_frame.depth_file;
  SCANTROVE_TRY(checkFile(depth_file, key_frame.depth_checksum));
  SCANTROVE_TRY(moveInto(read.depth, orLeftOut(readGrayImage(depth_file), depth_file)));
  if (read.depth.type() != CV_16UC1) {
    return fail("The key frame image " + depth_file.string() + " is no 16-bit depth image.",
                "That frame is left out; the rest can be used.");
  }
  if (frame.intrinsics && read.depth.size() != cv::Size(frame.intrinsics->width, frame.intrinsics->height)) {
    return fail("The key frame image " + depth_file.string() + " has another size than its camera.",
                "That frame is left out; the rest can be used.");
  }
  if (!key_frame.color_file.empty()) {
    read.color_file = session_folder / key_frame.color_file;
    SCANTROVE_TRY(checkFile(read.color_file, key_frame.color_checksum));
    SCANTROVE_TRY(moveInto(read.color, orLeftOut(readColorImage(read.color_file), read.color_file)));
  }
  return read;
}

}  // namespace scantrove
