#include "ui/painting/mask_picture.h"

#include <QColor>
#include <algorithm>
#include <cstdint>
#include <map>

#include "core/exchange/region_palette.h"

namespace scantrove {
namespace {

/// Smaller parts of an image get no name.
constexpr double kLeastNamed = 0.0005;

bool isBorder(const cv::Mat& regions, int x, int y) {
  const int own = regions.at<int>(y, x);
  return (x > 0 && regions.at<int>(y, x - 1) != own) ||
         (x + 1 < regions.cols && regions.at<int>(y, x + 1) != own) ||
         (y > 0 && regions.at<int>(y - 1, x) != own) ||
         (y + 1 < regions.rows && regions.at<int>(y + 1, x) != own);
}

/// Pixels of a region in an image.
struct RegionPixels {
  double x = 0, y = 0, count = 0;  ///< sums
  QPointF nearest;                 ///< the pixel nearest to the middle
  double distance2 = 0;
};

}  // namespace

QImage maskPicture(const cv::Mat& regions, MaskStyle style) {
  if (regions.empty() || style == MaskStyle::none) return {};
  QImage picture(regions.cols, regions.rows, QImage::Format_ARGB32_Premultiplied);
  int last = 0;
  QRgb color = 0;
  for (int y = 0; y < regions.rows; ++y) {
    const auto* row = regions.ptr<int>(y);
    auto* out = reinterpret_cast<QRgb*>(picture.scanLine(y));
    for (int x = 0; x < regions.cols; ++x) {
      if (row[x] != last) {
        last = row[x];
        const Rgb rgb = regionColor(RegionId{static_cast<std::uint32_t>(last)});
        color = last > 0 ? qRgb(rgb[0], rgb[1], rgb[2]) : 0;
      }
      out[x] = style == MaskStyle::fill || isBorder(regions, x, y) ? color : 0;
    }
  }
  return picture;
}

QImage emptyDraft(const QSize& size) {
  QImage picture(size, QImage::Format_ARGB32_Premultiplied);
  picture.fill(Qt::transparent);
  return picture;
}

void paintDraft(QImage& picture, const cv::Mat& draft, const QRect& part, const QColor& color) {
  const QRect box = part & picture.rect();
  const QRgb painted = qPremultiply(color.rgba());
  for (int y = box.top(); y <= box.bottom(); ++y) {
    const auto* row = draft.ptr(y);
    auto* out = reinterpret_cast<QRgb*>(picture.scanLine(y));
    for (int x = box.left(); x <= box.right(); ++x) out[x] = row[x] != 0 ? painted : 0;
  }
}

std::vector<MaskName> maskNames(const cv::Mat& regions, const std::function<QString(RegionId)>& name_of) {
  std::map<int, RegionPixels> found;
  const auto forEachPixel = [&](auto&& use) {
    for (int y = 0; y < regions.rows; ++y) {
      const auto* row = regions.ptr<int>(y);
      auto last = found.end();
      for (int x = 0; x < regions.cols; ++x) {
        if (row[x] <= 0) continue;
        if (last == found.end() || last->first != row[x]) last = found.try_emplace(row[x]).first;
        use(last->second, x, y);
      }
    }
  };
  forEachPixel([](RegionPixels& pixels, int x, int y) {
    pixels.x += x;
    pixels.y += y;
    ++pixels.count;
  });
  forEachPixel([](RegionPixels& pixels, int x, int y) {
    const double dx = x - pixels.x / pixels.count, dy = y - pixels.y / pixels.count;
    const double distance2 = dx * dx + dy * dy;
    if (!pixels.nearest.isNull() && distance2 >= pixels.distance2) return;
    pixels.nearest = {x + 0.5, y + 0.5};
    pixels.distance2 = distance2;
  });
  std::vector<MaskName> names;
  const double least = kLeastNamed * static_cast<double>(regions.total());
  for (const auto& [region, pixels] : found) {
    if (pixels.count < least) continue;
    const QString name = name_of(RegionId{static_cast<std::uint32_t>(region)});
    if (!name.isEmpty()) names.push_back({pixels.nearest, name});
  }
  return names;
}

}  // namespace scantrove
