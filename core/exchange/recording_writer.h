#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/base/file_lock.h"
#include "core/base/result.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// Writes frames as a recording in the 7-Scenes layout, which openSource() reads back:
///
///     frame-NNNNNN.color.png .depth.png .pose.txt   those that the frame has; NNNNNN is its index
///     frame-NNNNNN.intrinsics.txt                   3x3 camera of depth, if the frame has its own
///     frame-NNNNNN.instance.png                     16 bit, 0 = none; only with ground truth
///     intrinsic.json                                camera, depth units per metre, colour registration
///     instances.json                                [{id, name, object, extent_m}]; only with ground truth
///
/// A frame is written completely or not at all. Foreign files in the folder are neither replaced nor removed.
/// Readings of low confidence are written as no readings. The layout has no times: readers assume NNNNNN
/// / 30.
class RecordingWriter {
 public:
  /// Creates `folder`. Error: it cannot be written to, is not empty, or another recording claims it.
  [[nodiscard]] static Result<RecordingWriter> create(const std::filesystem::path& folder,
                                                      const SourceInfo& info);

  /// Adds a frame; each index only once. Error: names the file; partly written files of this frame are
  /// removed.
  [[nodiscard]] Result<void> add(const RgbdFrame& frame);

 private:
  RecordingWriter(std::filesystem::path folder, FileLock lock, SourceInfo info)
      : folder_(std::move(folder)), lock_(std::move(lock)), info_(std::move(info)) {}
  [[nodiscard]] Result<void> describeCamera(const RgbdFrame& frame);
  [[nodiscard]] Result<void> writeParts(const RgbdFrame& frame);
  /// Error: also if a file of that name exists.
  [[nodiscard]] Result<void> write(const std::filesystem::path& path, std::string_view bytes);
  [[nodiscard]] std::filesystem::path pathOf(int index, const char* suffix) const;

  std::filesystem::path folder_;
  FileLock lock_;
  SourceInfo info_;
  bool is_described_ = false;
  std::vector<std::filesystem::path> of_frame_;  // files written for the current frame
};

}  // namespace scantrove
