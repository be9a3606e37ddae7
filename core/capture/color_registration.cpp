#include "core/capture/color_registration.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/base/text.h"
#include "core/capture/camera_intrinsics.h"

namespace scantrove {
namespace {

constexpr const char* kRegistrationAdvice =
    "Give --color-registration registered, kinect, or the colour camera: fx,fy,cx,cy in pixels and x (or "
    "x,y,z, or x,y,z,rx,ry,rz) of T_color_depth in metres and degrees, e.g. 525,525,319.5,239.5,-0.025.";
constexpr double kFarthest_m = 1;

std::string sizeText(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

bool haveOneShape(const cv::Size& size, const Intrinsics& K) {
  return std::int64_t{size.width} * K.height == std::int64_t{size.height} * K.width;
}

/// Whether aspect ratios differ by at most a hundredth, as of 1296 x 968 and 640 x 480: a lower resolution is
/// rounded to whole blocks of pixels.
bool areAlike(const cv::Size& size, const Intrinsics& K) {
  constexpr double kMaxDifference = 0.01;
  const double across = static_cast<double>(size.width) * K.height;
  const double down = static_cast<double>(size.height) * K.width;
  return std::abs(across - down) <= kMaxDifference * down;
}

}  // namespace

ColorCamera kinectColorCamera() {
  ColorCamera camera{{528, 528, 320, 240, 640, 480}};
  camera.T_color_depth.translation().x() = -0.025;
  return camera;
}

Result<ColorRegistration> parseColorRegistration(const std::string& text) {
  if (text == "registered") return ColorRegistration{};
  if (text == "kinect") return ColorRegistration{kinectColorCamera()};
  const auto values = parseNumbers(text);
  const std::size_t count = values ? values->size() : 0;
  if (count != 5 && count != 7 && count != 10) {
    return fail("'" + text + "' does not say how colour lies over depth.", kRegistrationAdvice);
  }
  if (!std::ranges::all_of(*values, [](double value) { return std::isfinite(value); })) {
    return fail("'" + text + "' has values that are not finite.", kRegistrationAdvice);
  }
  const auto at = [&](std::size_t i) { return i < count ? (*values)[i] : 0.0; };
  const auto pixels = [&](std::size_t i) { return static_cast<float>(at(i)); };
  ColorCamera camera{{pixels(0), pixels(1), pixels(2), pixels(3), 0, 0}};
  if (const auto checked = checkFocalLengths(camera.K, "--color-registration"); !checked) {
    return fail(checked.error().what, kRegistrationAdvice);
  }
  const Eigen::Vector3d offset_m(at(4), at(5), at(6));
  if (offset_m.norm() > kFarthest_m) {
    return fail("'" + text + "': a colour camera more than 1 m away from the depth camera.",
                kRegistrationAdvice);
  }
  const Eigen::Vector3d turn = Eigen::Vector3d(at(7), at(8), at(9)) * std::numbers::pi / 180;
  camera.T_color_depth.translation() = offset_m;
  if (turn.norm() > 0) {
    camera.T_color_depth.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  }
  return ColorRegistration{camera};
}

Result<std::optional<ColorCamera>> colorCameraFor(const ColorRegistration& registration, const cv::Size& size,
                                                  const Intrinsics& depth_K, const std::string& source) {
  const std::string images = "the colour images are " + sizeText(size.width, size.height);
  if (!registration.camera) {
    // Registered images show the same field of view at any two scales.
    if (areAlike(size, depth_K)) return std::optional<ColorCamera>();
    return fail(source + ": " + images + ", the depth images " + sizeText(depth_K.width, depth_K.height) +
                    ", so they cannot be registered.",
                kRegistrationAdvice);
  }
  ColorCamera camera = *registration.camera;
  constexpr double kFarthestOfFiles_m = 10;  // further than on any rig: not in metres, or damaged
  if (!camera.T_color_depth.matrix().allFinite() ||
      !(camera.T_color_depth.translation().norm() <= kFarthestOfFiles_m)) {
    return fail(source + ": its colour camera is said to be more than 10 m away from the depth camera.",
                kRegistrationAdvice);
  }
  if (camera.K.width > 0 && camera.K.height > 0 && !haveOneShape(size, camera.K)) {
    return fail(source + ": " + images + "; its colour camera is known for " +
                    sizeText(camera.K.width, camera.K.height) + " only.",
                kRegistrationAdvice);
  }
  camera.K = fitToImages({camera.K, std::nullopt}, size.width, size.height);
  if (const auto checked = checkIntrinsics(camera.K, "colour camera of " + source); !checked) {
    return fail(checked.error().what, kRegistrationAdvice);
  }
  return std::optional(camera);
}

}  // namespace scantrove
