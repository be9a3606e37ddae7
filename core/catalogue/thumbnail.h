#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>

namespace scantrove {

/// The detector's descriptor of one view (thesis 5.2): the crop at 32 x 32 in CIELAB, each channel
/// normalised to zero mean and unit variance over the object's pixels. The background is 0, so the scene
/// behind the object has no effect. Values are stored as round(32 * value), clamped to +-127: 8 bits keep
/// the memory traffic low.
struct Thumbnail {
  static constexpr int kSide = 32, kPixels = kSide * kSide;
  static constexpr int kCoarseSide = 16, kCoarsePixels = kCoarseSide * kCoarseSide;
  static constexpr float kUnit = 32;  ///< stored value of 1

  std::array<std::int8_t, 3 * kPixels> fine{};          ///< planes L, a, b; each row by row
  std::array<std::int8_t, 3 * kCoarsePixels> coarse{};  ///< means of 2 x 2 pixels of `fine`, rounded half up
  Eigen::Vector3f mean_lab = Eigen::Vector3f::Zero();   ///< before normalisation, CIE units (L 0..100)
};

/// `color` (CV_8UC3 BGR) and `mask` (CV_8UC1) share any size. None: no colour or no object pixel. A nearly
/// uniform channel is divided by a minimum deviation, because it would be only noise otherwise.
[[nodiscard]] std::optional<Thumbnail> makeThumbnail(const cv::Mat& color, const cv::Mat& mask);

/// Computes `coarse` from `fine`.
void fillCoarse(Thumbnail& thumbnail);

}  // namespace scantrove
