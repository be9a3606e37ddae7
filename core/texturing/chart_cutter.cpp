#include "core/texturing/chart_cutter.h"

#include <utility>

namespace scantrove {

TextureCharts cutCharts(const ViewedSurface& viewed, std::span<const std::uint32_t> faces,
                        std::size_t min_faces) {
  std::vector<bool> is_open(viewed.surface.faces.size(), false);
  for (const std::uint32_t face : faces) is_open[face] = true;
  std::vector<ViewProjection> projections;
  for (const TextureView& view : viewed.views) projections.emplace_back(view);
  TextureCharts cut;
  for (const std::uint32_t seed : faces) {
    if (!is_open[seed]) continue;
    is_open[seed] = false;
    TextureChart chart{viewed.face_views[seed], {seed}, {}};
    if (chart.view == kNoView) {
      cut.without_view.push_back(seed);
      continue;
    }
    for (std::size_t i = 0; i < chart.faces.size(); ++i) {
      for (const std::uint32_t neighbor : viewed.neighbors[chart.faces[i]]) {
        if (neighbor == kNoFace || !is_open[neighbor] || viewed.face_views[neighbor] != chart.view) continue;
        is_open[neighbor] = false;
        chart.faces.push_back(neighbor);
      }
    }
    if (chart.faces.size() < min_faces) {
      cut.without_view.insert(cut.without_view.end(), chart.faces.begin(), chart.faces.end());
      continue;
    }
    for (const std::uint32_t face : chart.faces) {
      for (const std::uint32_t vertex : viewed.surface.faces[face])
        chart.box_px.extend(projections[chart.view].pixelOf(viewed.surface.positions_m[vertex]));
    }
    cut.charts.push_back(std::move(chart));
  }
  return cut;
}

}  // namespace scantrove
