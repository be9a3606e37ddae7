#include "core/catalogue/thumbnail.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/base/check.h"

namespace scantrove {
namespace {

// CIE units: the variation of compressed camera images on a uniform surface.
constexpr std::array<float, 3> kMinDeviation = {4, 2, 2};

struct SmallCrop {
  cv::Mat lab;     // 32 x 32, CV_32FC3, means over the object's pixels only
  cv::Mat weight;  // 32 x 32, CV_32FC1, fraction of the pixel that shows the object
};

SmallCrop shrink(const cv::Mat& color, const cv::Mat& mask) {
  const cv::Size side(Thumbnail::kSide, Thumbnail::kSide);
  const auto resized = [&](const cv::Mat& image) {
    cv::Mat small;
    const bool shrinks = image.cols > side.width && image.rows > side.height;
    cv::resize(image, small, side, 0, 0, shrinks ? cv::INTER_AREA : cv::INTER_LINEAR);
    return small;
  };
  cv::Mat masked(color.size(), CV_8UC3, cv::Scalar::all(0)), weight, bgr;
  color.copyTo(masked, mask);
  masked.convertTo(bgr, CV_32FC3, 1.0 / 255);
  cv::Mat(mask > 0).convertTo(weight, CV_32FC1, 1.0 / 255);
  SmallCrop small{resized(bgr), resized(weight)};
  for (int y = 0; y < side.height; ++y) {
    for (int x = 0; x < side.width; ++x) {
      const float w = small.weight.at<float>(y, x);
      if (w > 0) small.lab.at<cv::Vec3f>(y, x) *= 1 / w;
    }
  }
  cv::cvtColor(small.lab, small.lab, cv::COLOR_BGR2Lab);
  return small;
}

}  // namespace

std::optional<Thumbnail> makeThumbnail(const cv::Mat& color, const cv::Mat& mask) {
  if (color.empty() || mask.empty()) return std::nullopt;
  SCANTROVE_CHECK(color.type() == CV_8UC3 && mask.type() == CV_8UC1 && color.size() == mask.size());
  const SmallCrop small = shrink(color, mask);
  const double total = cv::sum(small.weight)[0];
  if (!(total > 0.5)) return std::nullopt;

  Thumbnail thumbnail;
  for (int c = 0; c < 3; ++c) {
    double sum = 0, squares = 0;
    for (int i = 0; i < Thumbnail::kPixels; ++i) {
      const double w = small.weight.ptr<float>()[i], value = small.lab.ptr<cv::Vec3f>()[i][c];
      sum += w * value;
      squares += w * value * value;
    }
    const double mean = sum / total;
    const double deviation = std::sqrt(std::max(squares / total - mean * mean, 0.0));
    const double unit = Thumbnail::kUnit /
                        std::max(deviation, static_cast<double>(kMinDeviation[static_cast<std::size_t>(c)]));
    thumbnail.mean_lab[c] = static_cast<float>(mean);
    std::int8_t* fine = thumbnail.fine.data() + c * Thumbnail::kPixels;
    for (int i = 0; i < Thumbnail::kPixels; ++i) {
      const double w = small.weight.ptr<float>()[i], value = small.lab.ptr<cv::Vec3f>()[i][c];
      const double stored = std::clamp(std::floor(w * (value - mean) * unit + 0.5), -127.0, 127.0);
      fine[i] = static_cast<std::int8_t>(stored);
    }
  }
  fillCoarse(thumbnail);
  return thumbnail;
}

void fillCoarse(Thumbnail& thumbnail) {
  for (int c = 0; c < 3; ++c) {
    const std::int8_t* fine = thumbnail.fine.data() + c * Thumbnail::kPixels;
    std::int8_t* coarse = thumbnail.coarse.data() + c * Thumbnail::kCoarsePixels;
    for (int y = 0; y < Thumbnail::kCoarseSide; ++y) {
      for (int x = 0; x < Thumbnail::kCoarseSide; ++x) {
        const std::int8_t* p = fine + 2 * y * Thumbnail::kSide + 2 * x;
        const int sum = p[0] + p[1] + p[Thumbnail::kSide] + p[Thumbnail::kSide + 1];
        *coarse++ = static_cast<std::int8_t>((sum + 2) >> 2);
      }
    }
  }
}

}  // namespace scantrove
