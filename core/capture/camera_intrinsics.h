#pragma once
#include <filesystem>
#include <optional>

#include "core/base/result.h"
#include "core/capture/color_camera.h"
#include "core/capture/intrinsics.h"
#include "core/capture/lens_distortion.h"

namespace scantrove {

/// A camera model whose image size may still be unknown.
struct CameraModel {
  Intrinsics K;  ///< width and height 0: valid for the recording's images of any size
  std::optional<double> units_per_meter;        ///< of the depth images; none: not in the file
  std::optional<ColorRegistration> color = {};  ///< none: not in the file
  std::optional<LensDistortion> lens = {};  ///< of both cameras, registered to each other; none: a pinhole
  bool is_color_optional = false;           ///< frames without a colour image are depth only, not damaged
};

/// 525 525 319.5 239.5 at 640x480: the usual default for PrimeSense cameras (Kinect, Xtion).
inline constexpr Intrinsics kPrimeSenseIntrinsics{525.0F, 525.0F, 319.5F, 239.5F, 640, 480};

/// Checks that all values are finite and fx, fy > 0. Error: names the value and `origin` ("--intrinsics", a
/// file).
[[nodiscard]] Result<void> checkFocalLengths(const Intrinsics& K, const std::string& origin);

/// Also checks the field of view (2 to 160 degrees in both directions). The principal point may lie at most
/// half an image outside.
[[nodiscard]] Result<void> checkIntrinsics(const Intrinsics& K, const std::string& origin);

/// Whether two intrinsics may be calibrations of one camera.
[[nodiscard]] bool isSameCamera(const Intrinsics& a, const Intrinsics& b);

/// The model scaled to images of `width` x `height`.
[[nodiscard]] Intrinsics fitToImages(const CameraModel& model, int width, int height);

/// Reads a 3x3 matrix, row by row (7-Scenes' `camera-intrinsics.txt`). Error: names the file.
[[nodiscard]] Result<CameraModel> readIntrinsicsMatrix(const std::filesystem::path& file);

/// Reads Open3D's JSON: `width`, `height`, `intrinsic_matrix` (nine values, column by column). Optional:
/// `depth_scale` (units per metre), `color_registered`, `color_optional`, and `color_camera` with the first
/// three again and `T_color_depth` (sixteen values, row by row). Error: names the file.
[[nodiscard]] Result<CameraModel> readIntrinsicsJson(const std::filesystem::path& file);

/// Reads ScanNet's `PREFIX_depth.txt` (4x4), and `PREFIX_color.txt`, `extrinsic_depth.txt`,
/// `extrinsic_color.txt` where present. Error: names the file.
[[nodiscard]] Result<CameraModel> readScannetIntrinsics(const std::filesystem::path& folder,
                                                        const std::string& prefix);

/// Reads the first of these files: `camera-intrinsics.txt`, `intrinsic.json`, `camera_intrinsic.json`,
/// `cam_K.txt` (3x3), ScanNet's `intrinsic/intrinsic_depth.txt` (4x4, with those of colour). Searches the
/// recording's folder, then its parent for the last two (with a warning). Empty if none exists. Error: the
/// file cannot be used.
[[nodiscard]] Result<std::optional<CameraModel>> findIntrinsics(const std::filesystem::path& folder);

}  // namespace scantrove
