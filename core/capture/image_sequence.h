#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/capture/camera_intrinsics.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// One frame of a folder recording, before anything is decoded.
struct ImageSequenceEntry {
  int index = 0;
  double timestamp_s = 0;
  std::filesystem::path color;      ///< empty: not there
  std::filesystem::path depth;      ///< empty: not there
  std::filesystem::path pose_file;  ///< a 4x4 matrix; empty: none
  std::optional<Eigen::Isometry3d> T_world_camera;
};

/// What a folder's layout says; made by the one file per layout.
struct ImageSequence {
  std::string kind;
  std::filesystem::path folder;
  std::vector<ImageSequenceEntry> entries;  ///< in recording order
  CameraModel camera;                       ///< SourceOptions override it
  std::string camera_origin;                ///< for messages: the file, or "default"
  double units_per_meter = 1000;            ///< SourceOptions override it
  bool has_color = true;                    ///< false: depth only; else a frame without colour is skipped
  bool has_poses = false;
  ColorRegistration color;  ///< of the layout; `camera` and SourceOptions override it
};

/// Makes a source of it: selects the frames, and decodes the first usable one to learn the image size, which
/// decides the intrinsics. Per frame: skipped if an image is missing, damaged, of a wrong type or of another
/// size than the first frame's; a pose that cannot be used leaves the frame without one. Failed once the
/// folder is gone. Error: bad options, no frame can be used, colour that does not fit its registration.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openImageSequence(ImageSequence sequence,
                                                                     const SourceOptions& options);

}  // namespace scantrove
