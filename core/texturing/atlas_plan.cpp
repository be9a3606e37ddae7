#include "core/texturing/atlas_plan.h"

#include <algorithm>
#include <cmath>

#include "core/texturing/rect_packer.h"

namespace scantrove {
namespace {

constexpr int kSmallestAtlas_px = 256;
constexpr int kCell_px = 4;
constexpr int kPaletteColors = 32 * 32 * 32;
/// Packed rectangles leave some room between them.
constexpr double kUsableArea = 0.95, kExpectedArea = 0.8;
constexpr double kScaleStep = 0.93, kLeastScale = 0.1;

/// The place of a chart's pixels in its resized image, with the pad.
cv::Rect pixelsOf(const TextureChart& chart, const TextureView& view, double scale) {
  const Intrinsics K = ViewProjection::scaled(view.K, scale);
  const float sx = static_cast<float>(K.width) / static_cast<float>(view.K.width);
  const float sy = static_cast<float>(K.height) / static_cast<float>(view.K.height);
  const auto resized = [](float pixel, float s) { return (pixel + 0.5F) * s - 0.5F; };
  const Eigen::Vector2f &low = chart.box_px.min(), &high = chart.box_px.max();
  const cv::Point first(static_cast<int>(std::floor(resized(low.x(), sx))) - kChartPad_px,
                        static_cast<int>(std::floor(resized(low.y(), sy))) - kChartPad_px);
  const cv::Point last(static_cast<int>(std::ceil(resized(high.x(), sx))) + kChartPad_px,
                       static_cast<int>(std::ceil(resized(high.y(), sy))) + kChartPad_px);
  return {first, last + cv::Point(1, 1)};
}

int rowsFor(int count, int per_row) { return (count + per_row - 1) / per_row; }

/// Sets the cells and the height of their rows, for faces without a view.
int planCells(AtlasPlan& plan, std::size_t faces) {
  if (faces == 0) return 0;
  const auto quarter = static_cast<double>(plan.size.area()) / 4;
  const bool has_room = static_cast<double>(faces) * kCell_px * kCell_px <= quarter;
  plan.cell_px = has_room ? kCell_px : 1;
  return has_room ? kCell_px * rowsFor(static_cast<int>(faces), plan.size.width / kCell_px)
                  : rowsFor(kPaletteColors, plan.size.width);
}

/// A texture that is `width` wide and at most as high.
std::optional<AtlasPlan> planAt(const TextureCharts& cut, std::span<const TextureView> views, int width,
                                double scale) {
  AtlasPlan plan;
  plan.size = cv::Size(width, width);
  plan.scale = scale;
  const int cell_rows = planCells(plan, cut.without_view.size());
  std::vector<cv::Size> sizes;
  double area = 0;
  for (const TextureChart& chart : cut.charts) {
    const cv::Rect pixels = pixelsOf(chart, views[chart.view], scale);
    plan.places.push_back({pixels, pixels.tl()});
    sizes.push_back(pixels.size());
    area += static_cast<double>(pixels.area());
  }
  const cv::Size room(width, width - cell_rows);
  if (area > kUsableArea * static_cast<double>(room.area())) return std::nullopt;
  const auto packed = packRects(sizes, room);
  if (!packed) return std::nullopt;
  for (std::size_t i = 0; i < packed->size(); ++i) {
    plan.places[i].rect = cv::Rect((*packed)[i], sizes[i]);
    plan.first_cell_row = std::max(plan.first_cell_row, plan.places[i].rect.br().y);
  }
  plan.size.height = std::max(1, plan.first_cell_row + cell_rows);
  return plan;
}

}  // namespace

double texelsOf(const TextureCharts& cut) {
  double texels = 0;
  for (const TextureChart& chart : cut.charts) {
    const Eigen::Vector2f sides = chart.box_px.sizes() + Eigen::Vector2f::Constant(2 * kChartPad_px + 1);
    texels += static_cast<double>(sides.x()) * static_cast<double>(sides.y());
  }
  return texels;
}

std::optional<AtlasPlan> planAtlas(const TextureCharts& cut, std::span<const TextureView> views,
                                   int max_size_px, double max_scale) {
  const double texels = texelsOf(cut) * max_scale * max_scale +
                        static_cast<double>(cut.without_view.size()) * kCell_px * kCell_px;
  int width = std::min(kSmallestAtlas_px, max_size_px);
  while (width < max_size_px && kExpectedArea * width * width < texels)
    width = std::min(2 * width, max_size_px);
  for (; width < max_size_px; width = std::min(2 * width, max_size_px)) {
    if (auto plan = planAt(cut, views, width, max_scale)) return plan;
  }
  for (double scale = max_scale; scale > kLeastScale * max_scale; scale *= kScaleStep) {
    if (auto plan = planAt(cut, views, width, scale)) return plan;
  }
  return std::nullopt;
}

}  // namespace scantrove
