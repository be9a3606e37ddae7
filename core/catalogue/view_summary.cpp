#include "core/catalogue/view_summary.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/catalogue/image_blob.h"

namespace scantrove {
namespace {

constexpr double kBackgroundBrightness = 0.4;

std::string flawOf(const char* what, const cv::Mat& image, int type, const cv::Size& size) {
  if (image.empty()) return {};
  if (image.type() != type) return std::string("its ") + what + " is of another type of image";
  if (image.size() != size) {
    return std::string("its ") + what + " is " + std::to_string(image.cols) + " x " +
           std::to_string(image.rows) + " pixels and not " + std::to_string(size.width) + " x " +
           std::to_string(size.height);
  }
  return {};
}

}  // namespace

std::string flawOf(const ObjectView& view) {
  const cv::Size size = view.mask.empty() ? view.color.size() : view.mask.size();
  std::string flaw = flawOf("mask", view.mask, CV_8UC1, size);
  if (flaw.empty()) flaw = flawOf("colour", view.color, CV_8UC3, size);
  if (flaw.empty())
    flaw = flawOf("depth", view.depth_mm, CV_16UC1, size.empty() ? view.depth_mm.size() : size);
  return flaw;
}

ViewSummary summarize(const ObjectView& view) {
  ViewSummary summary;
  if (!view.mask.empty()) summary.object_pixels = cv::countNonZero(view.mask);
  summary.descriptor = view.descriptor ? view.descriptor : describeView(view.color, view.mask);
  summary.picture_jpeg = toJpeg(listPicture(view.color, view.mask));
  return summary;
}

cv::Mat listPicture(const cv::Mat& color, const cv::Mat& mask, int longest_side) {
  if (color.empty()) return {};
  const double scale = static_cast<double>(longest_side) / std::max(color.cols, color.rows);
  cv::Mat small_color = color, weight(color.size(), CV_8UC1, cv::Scalar(255));
  if (!mask.empty()) weight = mask > 0;
  if (scale < 1) {
    const cv::Size size(std::max(1, cvRound(color.cols * scale)), std::max(1, cvRound(color.rows * scale)));
    cv::resize(color, small_color, size, 0, 0, cv::INTER_AREA);
    cv::resize(weight, weight, size, 0, 0, cv::INTER_AREA);
  }
  cv::Mat picture(small_color.size(), CV_8UC3);
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const double w = weight.at<std::uint8_t>(y, x) / 255.0;
      picture.at<cv::Vec3b>(y, x) = small_color.at<cv::Vec3b>(y, x) * (w + (1 - w) * kBackgroundBrightness);
    }
  }
  return picture;
}

}  // namespace scantrove
