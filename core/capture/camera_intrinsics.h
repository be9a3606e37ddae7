#pragma once
#include <filesystem>
#include <optional>

#include "core/base/result.h"
#include "core/capture/color_camera.h"
#include "core/capture/intrinsics.h"
#include "core/capture/lens_distortion.h"

namespace scantrove {

/// A camera whose image size may be unknown yet.
struct CameraModel {
  Intrinsics K;  ///< width and height 0: the values hold for the recording's images, whatever their size
  std::optional<double> units_per_meter;        ///< of the depth images, where the file says so
  std::optional<ColorRegistration> color = {};  ///< where the file says it
  std::optional<LensDistortion> lens = {};  ///< of both cameras, registered to each other; none: a pinhole
};

/// 525 525 319.5 239.5 at 640x480: the usual guess for a PrimeSense camera (Kinect, Xtion).
inline constexpr Intrinsics kPrimeSenseIntrinsics{525.0F, 525.0F, 319.5F, 239.5F, 640, 480};

/// Nothing if all are finite and fx, fy > 0. Error: names the value and `origin` ("--intrinsics", a file).
[[nodiscard]] Result<void> checkFocalLengths(const Intrinsics& K, const std::string& origin);

/// The same, and for the images of K: the camera sees 2 to 160 degrees in both directions and its centre lies
/// at most half an image outside.
[[nodiscard]] Result<void> checkIntrinsics(const Intrinsics& K, const std::string& origin);

/// The model for images of `width` x `height`: resized if it was for another size.
[[nodiscard]] Intrinsics fitToImages(const CameraModel& model, int width, int height);

/// Reads a 3x3 matrix, row by row (7-Scenes' `camera-intrinsics.txt`). Error: names the file.
[[nodiscard]] Result<CameraModel> readIntrinsicsMatrix(const std::filesystem::path& file);

/// Reads Open3D's JSON: `width`, `height`, `intrinsic_matrix` (nine values, column by column), and where they
/// are there `depth_scale` (units per metre), `color_registered`, and `color_camera`: the first three again,
/// and `T_color_depth` (sixteen values, row by row). Error: names the file.
[[nodiscard]] Result<CameraModel> readIntrinsicsJson(const std::filesystem::path& file);

/// Looks for `camera-intrinsics.txt`, `intrinsic.json`, `camera_intrinsic.json`, `cam_K.txt` (3x3) and
/// ScanNet's `intrinsic/intrinsic_depth.txt` (4x4, with those of colour) in a recording's folder, then for
/// the last two beside it (with a warning), and reads the first that is there; empty if none is. Error: it is
/// there and cannot be used.
[[nodiscard]] Result<std::optional<CameraModel>> findIntrinsics(const std::filesystem::path& folder);

}  // namespace scantrove
