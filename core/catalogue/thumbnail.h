#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>

namespace scantrove {

/// What the detector remembers of one look at an object (thesis 5.2): its crop, 32 x 32, CIELAB, each channel
/// zero mean and unit variance over the object's pixels; the background is 0, the mean, so that another scene
/// behind the object changes nothing. Values are stored as round(32 * value), clamped to +-127: 8 bits keep
/// the memory traffic low.
struct Thumbnail {
  static constexpr int kSide = 32, kPixels = kSide * kSide;
  static constexpr int kCoarseSide = 16, kCoarsePixels = kCoarseSide * kCoarseSide;
  static constexpr float kUnit = 32;  ///< stored value of 1

  std::array<std::int8_t, 3 * kPixels> fine{};          ///< planes L, a, b; each row by row
  std::array<std::int8_t, 3 * kCoarsePixels> coarse{};  ///< means of 2 x 2 pixels of `fine`, rounded half up
  Eigen::Vector3f mean_lab = Eigen::Vector3f::Zero();   ///< before normalisation, CIE units (L 0..100)
};

/// `color` CV_8UC3 BGR and `mask` CV_8UC1 of the same size, any size. Nothing when there is no colour or no
/// object pixel. A channel that hardly varies is divided by a least deviation instead of its own, or it would
/// be noise only.
[[nodiscard]] std::optional<Thumbnail> makeThumbnail(const cv::Mat& color, const cv::Mat& mask);

/// `coarse` from `fine`.
void fillCoarse(Thumbnail& thumbnail);

}  // namespace scantrove
