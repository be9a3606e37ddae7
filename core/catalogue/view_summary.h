#pragma once
#include <QByteArray>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "core/catalogue/object_record.h"

namespace scantrove {

/// What is computed once of a view's images.
struct ViewSummary {
  int object_pixels = 0;  ///< area of the mask
  std::optional<Thumbnail> descriptor;
  QByteArray picture_jpeg;  ///< see listPicture; no bytes when the view has no colour
};

/// What is wrong with a view's images, as the end of a sentence; empty when they belong together: types as in
/// ObjectView, all that are not empty of one size.
[[nodiscard]] std::string flawOf(const ObjectView& view);

/// The descriptor is the view's own if it carries one. `flawOf(view)` must be empty.
[[nodiscard]] ViewSummary summarize(const ObjectView& view);

/// A small BGR picture of a view, its longest side at most kListPictureSide: the background dimmed, so that
/// the object stands out.
inline constexpr int kListPictureSide = 128;
[[nodiscard]] cv::Mat listPicture(const cv::Mat& color, const cv::Mat& mask);

}  // namespace scantrove
