#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/capture/camera_intrinsics.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// Decodes an image that is no file of its own (in an archive or a video). Called in recording order, those
/// of the first frames once more before that; on the source's thread. Depth: as readAnyDepth() returns it.
using ImageDecoder = std::function<Result<cv::Mat>()>;

/// One undecoded frame of a folder recording.
struct ImageSequenceEntry {
  int index = 0;
  double timestamp_s = 0;
  std::filesystem::path color;       ///< empty: not there
  std::filesystem::path depth;       ///< empty: not there
  std::filesystem::path confidence;  ///< an 8-bit image, ImageSequence::confidences; empty: none
  ImageDecoder decode_color, decode_depth, decode_confidence;  ///< in place of a file
  /// The frame's own camera, for images of its width and height; none: ImageSequence::camera.
  std::optional<Intrinsics> intrinsics;
  std::filesystem::path intrinsics_file;  ///< the same: 3x3, of the depth images' size; empty: none
  std::filesystem::path pose_file;        ///< a 4x4 matrix; empty: none
  std::optional<Eigen::Isometry3d> T_world_camera;
};

/// Contents of a recording; made by the one source file of its layout.
struct ImageSequence {
  std::string kind;
  std::filesystem::path folder;             ///< or the file that holds all frames
  std::vector<ImageSequenceEntry> entries;  ///< in recording order
  CameraModel camera;                       ///< SourceOptions override it
  std::string camera_origin;                ///< for messages: the file, or "default"
  double units_per_meter = 1000;   ///< of 16-bit depth; floats are metres. SourceOptions override both
  bool has_color = true;           ///< false: depth only; else a frame without colour is skipped
  bool is_color_optional = false;  ///< with colour: frames without it are depth only
  bool has_poses = false;
  PoseOrigin pose_origin = PoseOrigin::truth;
  /// Values of confidence images, from kLowConfidence to kHighConfidence: 0, 1, 2 or 0, 127, 255.
  std::array<int, 3> confidences{0, 1, 2};
  ColorRegistration color;  ///< of the layout; `camera` and SourceOptions override it
};

/// Makes a source from the folder: selects the frames and decodes the first usable one, whose image size
/// decides the intrinsics. A frame is skipped if an image is missing, damaged, of a wrong type, or differs in
/// size or type from the first, or if its own camera is impossible. Depth may have any type of
/// readAnyDepth(); frames have 16 bits. An unusable pose leaves the frame without pose. Reading fails once
/// the folder is gone. Error: bad options, no usable frame, colour that does not fit its registration.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openImageSequence(ImageSequence sequence,
                                                                     const SourceOptions& options);

}  // namespace scantrove
