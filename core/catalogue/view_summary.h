#pragma once
#include <QByteArray>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "core/catalogue/object_record.h"

namespace scantrove {

/// Values computed once from a view's images.
struct ViewSummary {
  int object_pixels = 0;  ///< area of the mask
  std::optional<ViewDescriptor> descriptor;
  QByteArray picture_jpeg;  ///< see listPicture; no bytes when the view has no colour
};

/// The flaw of a view's images, as the end of a sentence. Empty: types are as in ObjectView, and all
/// non-empty images have one size.
[[nodiscard]] std::string flawOf(const ObjectView& view);

/// Uses the view's own descriptor if it has one. `flawOf(view)` must be empty.
[[nodiscard]] ViewSummary summarize(const ObjectView& view);

/// A BGR picture of a view, its longest side at most `longest_side`; the background is dimmed to set off the
/// object.
inline constexpr int kListPictureSide = 128;
[[nodiscard]] cv::Mat listPicture(const cv::Mat& color, const cv::Mat& mask,
                                  int longest_side = kListPictureSide);

}  // namespace scantrove
