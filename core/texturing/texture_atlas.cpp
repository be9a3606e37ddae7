#include "core/texturing/texture_atlas.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace scantrove {
namespace {

/// Steps of a palette's colours, and bits that they leave out.
constexpr unsigned kPaletteBits = 5, kPaletteShift = 3;

Eigen::Vector3f bgrOf(const std::array<std::uint8_t, 3>& rgb) {
  return {static_cast<float>(rgb[2]), static_cast<float>(rgb[1]), static_cast<float>(rgb[0])};
}

cv::Vec3b roundedColor(const Eigen::Vector3f& bgr) {
  return {cv::saturate_cast<std::uint8_t>(bgr[0]), cv::saturate_cast<std::uint8_t>(bgr[1]),
          cv::saturate_cast<std::uint8_t>(bgr[2])};
}

Eigen::Vector3f colorAt(const cv::Mat& image, int x, int y) {
  const auto& bgr = image.at<cv::Vec3b>(y, x);
  return {static_cast<float>(bgr[0]), static_cast<float>(bgr[1]), static_cast<float>(bgr[2])};
}

/// Visits texels whose centre lies in the triangle, with the weights of the corners.
template <class Use>
void forEachTexelWithin(const FaceTexture& corners, const Use& use) {
  constexpr float kRounding = 1e-4F;  // texels on an edge belong to both triangles
  const auto &a = corners[0], &b = corners[1], &c = corners[2];
  const auto area = [](const Eigen::Vector2f& p, const Eigen::Vector2f& q, const Eigen::Vector2f& r) {
    return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
  };
  const float whole = area(a, b, c);
  const Eigen::Vector2f low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
  for (int y = static_cast<int>(std::ceil(low.y())); y <= static_cast<int>(high.y()) && whole != 0; ++y) {
    for (int x = static_cast<int>(std::ceil(low.x())); x <= static_cast<int>(high.x()); ++x) {
      const Eigen::Vector2f p(static_cast<float>(x), static_cast<float>(y));
      const Eigen::Vector3f weights(area(b, c, p) / whole, area(c, a, p) / whole, area(a, b, p) / whole);
      if (weights.minCoeff() >= -kRounding) use(x, y, weights);
    }
  }
}

/// Visits texels that the edges of the triangle pass, likewise.
template <class Use>
void forEachTexelOnEdges(const FaceTexture& corners, const Use& use) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Eigen::Vector2f& from = corners[static_cast<std::size_t>(i)];
    const Eigen::Vector2f along = corners[static_cast<std::size_t>(j)] - from;
    const int steps = 1 + static_cast<int>(2 * along.cwiseAbs().maxCoeff());
    for (int k = 0; k < steps; ++k) {
      const float t = static_cast<float>(k) / static_cast<float>(steps);
      const Eigen::Vector2f p = from + t * along;
      Eigen::Vector3f weights = Eigen::Vector3f::Zero();
      weights[i] = 1 - t;
      weights[j] = t;
      use(static_cast<int>(std::floor(p.x() + 0.5F)), static_cast<int>(std::floor(p.y() + 0.5F)), weights);
    }
  }
}

/// Visits the eight texels around one that lie in `rect`.
template <class Use>
void forEachAround(const cv::Rect& rect, const cv::Point& texel, const Use& use) {
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const cv::Point p = texel + cv::Point(dx, dy);
      if ((dx != 0 || dy != 0) && rect.contains(p)) use(p);
    }
  }
}

}  // namespace

const cv::Mat& ResizedImages::at(const cv::Size& size) {
  if (size == image_.size()) return image_;
  cv::Mat& resized = resized_[{size.width, size.height}];
  if (resized.empty()) cv::resize(image_, resized, size, 0, 0, cv::INTER_AREA);
  return resized;
}

TextureAtlas::TextureAtlas(const ViewedSurface& viewed, TextureCharts cut, AtlasPlan plan)
    : viewed_(viewed),
      cut_(std::move(cut)),
      plan_(std::move(plan)),
      image_(cv::Mat::zeros(plan_.size, CV_8UC3)) {
  paintCells();
}

void TextureAtlas::paint(ViewNumber view, ResizedImages& image) {
  const Intrinsics K = ViewProjection::scaled(viewed_.views[view].K, plan_.scale);
  const cv::Rect all(0, 0, K.width, K.height);
  for (std::size_t chart = 0; chart < cut_.charts.size(); ++chart) {
    if (cut_.charts[chart].view != view) continue;
    const auto& [rect, origin] = plan_.places[chart];
    const cv::Rect from = cv::Rect(origin, rect.size()) & all;
    if (from.empty()) continue;
    image.at(all.size())(from).copyTo(image_(cv::Rect(from.tl() - origin + rect.tl(), from.size())));
  }
}

void TextureAtlas::finish(const CornerOffsets& offsets) {
  cv::Mat is_covered = cv::Mat::zeros(plan_.size, CV_8UC1);
  for (std::size_t chart = 0; chart < cut_.charts.size(); ++chart) {
    levelChart(chart, offsets, is_covered);
    repeatRim(plan_.places[chart].rect, is_covered);
  }
}

void TextureAtlas::levelChart(std::size_t chart, const CornerOffsets& offsets, cv::Mat& is_covered) {
  const TextureChart& own = cut_.charts[chart];
  const ViewProjection projection(viewed_.views[own.view], plan_.scale);
  const cv::Rect& rect = plan_.places[chart].rect;
  int covered = 0;
  Eigen::Matrix3f of_corners = Eigen::Matrix3f::Zero();
  const auto level = [&](int x, int y, const Eigen::Vector3f& weights) {
    if (!rect.contains({x, y}) || is_covered.at<std::uint8_t>(y, x) != 0) return;
    is_covered.at<std::uint8_t>(y, x) = 1;
    ++covered;
    image_.at<cv::Vec3b>(y, x) = roundedColor(colorAt(image_, x, y) + of_corners * weights);
  };
  for (const std::uint32_t face : own.faces) {
    if (offsets) of_corners = offsets(face);
    forEachTexelWithin(texelsOf(chart, face, projection), level);
  }
  if (covered > 0) return;
  // All triangles lie between the centres. Else texels outside are not used: they may show what is behind.
  for (const std::uint32_t face : own.faces) {
    if (offsets) of_corners = offsets(face);
    forEachTexelOnEdges(texelsOf(chart, face, projection), level);
  }
}

void TextureAtlas::repeatRim(const cv::Rect& rect, cv::Mat& is_covered) {
  std::vector<cv::Point> rim;
  for (int y = rect.y; y < rect.br().y; ++y) {
    for (int x = rect.x; x < rect.br().x; ++x) {
      if (is_covered.at<std::uint8_t>(y, x) == 0) continue;
      bool is_at_rim = false;
      forEachAround(rect, {x, y},
                    [&](const cv::Point& p) { is_at_rim |= is_covered.at<std::uint8_t>(p) == 0; });
      if (is_at_rim) rim.emplace_back(x, y);
    }
  }
  constexpr std::uint8_t kNext = 2;  // found, not yet coloured
  for (int ring = 0; ring < kChartPad_px; ++ring) {
    std::vector<cv::Point> next;
    for (const cv::Point& texel : rim) {
      forEachAround(rect, texel, [&](const cv::Point& p) {
        if (is_covered.at<std::uint8_t>(p) != 0) return;
        is_covered.at<std::uint8_t>(p) = kNext;
        next.push_back(p);
      });
    }
    for (const cv::Point& texel : next) {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      float count = 0;
      forEachAround(rect, texel, [&](const cv::Point& p) {
        if (is_covered.at<std::uint8_t>(p) != 1) return;
        sum += colorAt(image_, p.x, p.y);
        ++count;
      });
      image_.at<cv::Vec3b>(texel) = roundedColor(sum / count);
    }
    for (const cv::Point& texel : next) is_covered.at<std::uint8_t>(texel) = 1;
    rim = std::move(next);
  }
}

FaceTexture TextureAtlas::texelsOf(std::size_t chart, std::uint32_t face,
                                   const ViewProjection& projection) const {
  const auto& [rect, origin] = plan_.places[chart];
  const Eigen::Vector2f shift(static_cast<float>(rect.x - origin.x), static_cast<float>(rect.y - origin.y));
  FaceTexture texels;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t vertex = viewed_.surface.faces[face][i];
    texels[i] = projection.pixelOf(viewed_.surface.positions_m[vertex]) + shift;
  }
  return texels;
}

FaceTexture TextureAtlas::cellOf(std::size_t number) const {
  if (plan_.cell_px > 1) {
    const auto per_row = static_cast<std::size_t>(plan_.size.width / plan_.cell_px);
    const auto side = static_cast<std::size_t>(plan_.cell_px);
    const std::size_t row = number / per_row, column = number % per_row;
    const Eigen::Vector2f first(
        static_cast<float>(side * column),
        static_cast<float>(static_cast<std::size_t>(plan_.first_cell_row) + side * row));
    const auto length = static_cast<float>(plan_.cell_px - 2);
    return {first, first + Eigen::Vector2f(length, 0), first + Eigen::Vector2f(0, length)};
  }
  const FaceCorners& face = viewed_.surface.faces[cut_.without_view[number]];
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (const std::uint32_t vertex : face) mean += bgrOf(viewed_.surface.colors[vertex]) / 3;
  unsigned color = 0;
  for (int i = 0; i < 3; ++i) color = color << kPaletteBits | static_cast<unsigned>(mean[i]) >> kPaletteShift;
  const auto width = static_cast<unsigned>(plan_.size.width);
  const unsigned row = color / width, column = color % width;
  const Eigen::Vector2f texel(static_cast<float>(column),
                              static_cast<float>(static_cast<unsigned>(plan_.first_cell_row) + row));
  return {texel, texel, texel};
}

void TextureAtlas::paintCells() {
  if (cut_.without_view.empty()) return;
  if (plan_.cell_px == 1) {
    constexpr unsigned kColors = 1U << (3 * kPaletteBits), kMask = (1U << kPaletteBits) - 1;
    const auto width = static_cast<unsigned>(plan_.size.width);
    const auto level = [](unsigned step) {  // the middle of the colours of a step
      return static_cast<std::uint8_t>((step << kPaletteShift) + (1U << (kPaletteShift - 1)));
    };
    for (unsigned color = 0; color < kColors; ++color) {
      const auto y = static_cast<int>(static_cast<unsigned>(plan_.first_cell_row) + color / width);
      image_.at<cv::Vec3b>(y, static_cast<int>(color % width)) = {
          level(color >> (2 * kPaletteBits)), level(color >> kPaletteBits & kMask), level(color & kMask)};
    }
    return;
  }
  for (std::size_t i = 0; i < cut_.without_view.size(); ++i) {
    const FaceCorners& face = viewed_.surface.faces[cut_.without_view[i]];
    const FaceTexture corners = cellOf(i);
    const Eigen::Vector3f a = bgrOf(viewed_.surface.colors[face[0]]);
    const float side = corners[1].x() - corners[0].x();
    const Eigen::Vector3f right = (bgrOf(viewed_.surface.colors[face[1]]) - a) / side;
    const Eigen::Vector3f down = (bgrOf(viewed_.surface.colors[face[2]]) - a) / side;
    for (int y = 0; y < plan_.cell_px; ++y) {
      for (int x = 0; x < plan_.cell_px; ++x) {
        const cv::Point texel(static_cast<int>(corners[0].x()) + x, static_cast<int>(corners[0].y()) + y);
        image_.at<cv::Vec3b>(texel) =
            roundedColor(a + static_cast<float>(x) * right + static_cast<float>(y) * down);
      }
    }
  }
}

std::vector<FaceTexture> TextureAtlas::textureOf(std::span<const std::uint32_t> faces) const {
  std::vector<FaceTexture> of_face(viewed_.surface.faces.size());
  for (std::size_t chart = 0; chart < cut_.charts.size(); ++chart) {
    const ViewProjection projection(viewed_.views[cut_.charts[chart].view], plan_.scale);
    for (const std::uint32_t face : cut_.charts[chart].faces)
      of_face[face] = texelsOf(chart, face, projection);
  }
  for (std::size_t i = 0; i < cut_.without_view.size(); ++i) of_face[cut_.without_view[i]] = cellOf(i);
  const Eigen::Array2f size(static_cast<float>(plan_.size.width), static_cast<float>(plan_.size.height));
  std::vector<FaceTexture> textures;
  textures.reserve(faces.size());
  for (const std::uint32_t face : faces) {
    FaceTexture texture = of_face[face];
    for (Eigen::Vector2f& corner : texture) corner = ((corner.array() + 0.5F) / size).matrix();
    textures.push_back(texture);
  }
  return textures;
}

}  // namespace scantrove
