#include "ui/panels/image_conversion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/exchange/region_palette.h"

namespace scantrove {
namespace {

constexpr QRgb kEmptyColor = 0xff15171bU;

/// 256 colours, near to far: OpenCV's Turbo from red to blue, without its darkest ends.
const std::array<QRgb, 256>& depthColors() {
  static const std::array<QRgb, 256> colors = [] {
    cv::Mat ramp(1, 256, CV_8UC1);
    for (int i = 0; i < 256; ++i)
      ramp.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(238 - i * 218 / 255);
    cv::Mat mapped;
    cv::applyColorMap(ramp, mapped, cv::COLORMAP_TURBO);
    std::array<QRgb, 256> table{};
    for (int i = 0; i < 256; ++i) {
      const auto& bgr = mapped.at<cv::Vec3b>(0, i);
      table[static_cast<std::size_t>(i)] = qRgb(bgr[2], bgr[1], bgr[0]);
    }
    return table;
  }();
  return colors;
}

template <class ColorOf>
QImage labelPicture(const cv::Mat& ids, const ColorOf& color_of) {
  if (ids.empty() || ids.type() != CV_32SC1) return {};
  QImage picture(ids.cols, ids.rows, QImage::Format_RGB32);
  for (int y = 0; y < ids.rows; ++y) {
    const auto* row = ids.ptr<std::int32_t>(y);
    const auto* below = y + 1 < ids.rows ? ids.ptr<std::int32_t>(y + 1) : row;
    auto* out = reinterpret_cast<QRgb*>(picture.scanLine(y));
    for (int x = 0; x < ids.cols; ++x) {
      const std::int32_t id = row[x];
      if (id <= 0) {
        out[x] = kEmptyColor;
        continue;
      }
      const Rgb c = color_of(static_cast<std::uint32_t>(id));
      const bool edge = (x + 1 < ids.cols && row[x + 1] != id) || below[x] != id;
      out[x] = edge ? qRgb(c[0] * 2 / 5, c[1] * 2 / 5, c[2] * 2 / 5) : qRgb(c[0], c[1], c[2]);
    }
  }
  return picture;
}

}  // namespace

QImage colorPicture(const cv::Mat& bgr) {
  if (bgr.empty() || bgr.type() != CV_8UC3) return {};
  auto* owner = new cv::Mat(bgr);
  return QImage(
      owner->data, owner->cols, owner->rows, static_cast<qsizetype>(owner->step[0]), QImage::Format_BGR888,
      [](void* mat) { delete static_cast<cv::Mat*>(mat); }, owner);
}

DepthRange usualRange(const cv::Mat& depth_m, const DepthRange& fallback) {
  if (depth_m.empty() || depth_m.type() != CV_32FC1) return fallback;
  std::vector<float> readings;
  for (int y = 0; y < depth_m.rows; y += 4) {
    const auto* row = depth_m.ptr<float>(y);
    for (int x = 0; x < depth_m.cols; x += 4) {
      if (row[x] > 0) readings.push_back(row[x]);
    }
  }
  if (readings.size() < 50) return fallback;
  const auto quantile = [&readings](double q) {
    const auto place =
        readings.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(readings.size() - 1));
    std::nth_element(readings.begin(), place, readings.end());
    return *place;
  };
  const float near_m = quantile(0.02);
  return {near_m, std::max(near_m + 0.2F, quantile(0.98))};
}

QImage depthPicture(const cv::Mat& depth_m, const DepthRange& range) {
  if (depth_m.empty() || depth_m.type() != CV_32FC1) return {};
  const std::array<QRgb, 256>& colors = depthColors();
  const float scale = 255 / std::max(0.01F, range.far_m - range.near_m);
  QImage picture(depth_m.cols, depth_m.rows, QImage::Format_RGB32);
  for (int y = 0; y < depth_m.rows; ++y) {
    const auto* row = depth_m.ptr<float>(y);
    auto* out = reinterpret_cast<QRgb*>(picture.scanLine(y));
    for (int x = 0; x < depth_m.cols; ++x) {
      const float z = row[x];
      const float place = std::clamp((z - range.near_m) * scale, 0.0F, 255.0F);
      out[x] = z > 0 ? colors[static_cast<std::size_t>(place)] : kEmptyColor;
    }
  }
  return picture;
}

QImage depthLegend(int width) {
  QImage legend(std::max(2, width), 1, QImage::Format_RGB32);
  for (int x = 0; x < legend.width(); ++x) {
    legend.setPixel(x, 0, depthColors()[static_cast<std::size_t>(x * 255 / (legend.width() - 1))]);
  }
  return legend;
}

QImage regionPicture(const cv::Mat& region_ids, const std::set<RegionId>& highlight) {
  const auto darkened = [](const Rgb& c) {
    return Rgb{static_cast<std::uint8_t>(c[0] / 4), static_cast<std::uint8_t>(c[1] / 4),
               static_cast<std::uint8_t>(c[2] / 4)};
  };
  return labelPicture(region_ids, [&](std::uint32_t id) {
    const Rgb color = regionColor(RegionId{id});
    return highlight.empty() || highlight.contains(RegionId{id}) ? color : darkened(color);
  });
}

QImage segmentPicture(const cv::Mat& segment_ids) {
  return labelPicture(segment_ids, [](std::uint32_t id) { return segmentColor(SegmentId{id}); });
}

}  // namespace scantrove
