#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core/types.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/color_camera.h"
#include "core/capture/intrinsics.h"
#include "core/capture/lens_distortion.h"

namespace scantrove {

// What a RealSense D4xx keeps of its calibration: tables that a command of its hardware monitor returns
// through a UVC extension unit, as the maker's library (librealsense, src/ds) reads them. Little-endian.

/// Tables that the device keeps.
enum class RealsenseTable : std::uint32_t {
  depth = 25,  ///< the rectified stereo pair
  color = 32,
};

/// Size of the control in bytes: a command is sent in it, the answer is read from it.
inline constexpr std::size_t kRealsenseControlBytes = 1024;

/// The command that asks for a table, of kRealsenseControlBytes.
[[nodiscard]] std::vector<std::uint8_t> realsenseTableCommand(RealsenseTable table);

/// The table in an answer to this command. Error: the device refused, or the size is impossible.
[[nodiscard]] Result<std::vector<std::uint8_t>> realsenseTableIn(std::span<const std::uint8_t> answer);

/// Intrinsics of depth images of `size`. Error: damaged (checksum), or not for this size.
[[nodiscard]] Result<Intrinsics> realsenseDepthIntrinsics(std::span<const std::uint8_t> table,
                                                          const cv::Size& size);

/// The colour camera of a RealSense, before its images are undistorted.
struct RealsenseColor {
  ColorCamera camera;
  LensDistortion lens;  ///< inverse: from distorted to undistorted coordinates
};

/// The colour camera for images of `size`. `is_d405`: its colour images are cropped differently. Error: as
/// above, or the place beside the depth camera is impossible.
[[nodiscard]] Result<RealsenseColor> realsenseColorCamera(std::span<const std::uint8_t> table,
                                                          const cv::Size& size, bool is_d405);

/// The usual intrinsics of the model (USB product) for images of `size`; single cameras differ by a few
/// percent.
[[nodiscard]] Intrinsics nominalRealsenseIntrinsics(std::uint16_t product, const cv::Size& size);

/// Whether the product is a D405, which measures in 0.1 mm and has its colour from the left depth imager.
[[nodiscard]] bool isRealsenseD405(std::uint16_t product);

}  // namespace scantrove
