#include "core/labeling/estimated_labels.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/camera_depth.h"

namespace scantrove {
namespace {

constexpr int kMaxConfidence = 8;  // as many frames must disagree before a cell changes its fragment
/// Measured surface farther behind a cell sees through it; nearer than this it is that cell's surface.
constexpr float kThrough_m = 0.03F;

}  // namespace

std::size_t EstimatedLabels::Hash::operator()(const Eigen::Vector3i& brick) const noexcept {
  constexpr std::size_t kX = 73856093, kY = 19349663, kZ = 83492791;  // Teschner et al. 2003
  return static_cast<std::size_t>(brick.x()) * kX ^ static_cast<std::size_t>(brick.y()) * kY ^
         static_cast<std::size_t>(brick.z()) * kZ;
}

Eigen::Vector3f EstimatedLabels::centerOf(const Eigen::Vector3i& brick, std::size_t cell) const {
  const auto index = static_cast<int>(cell);
  const Eigen::Vector3i inside(index % kSide, index / kSide % kSide, index / (kSide * kSide));
  return cell_m_ * ((kSide * brick + inside).cast<float>() + Eigen::Vector3f::Constant(0.5F));
}

template <class Bricks, class Visit>
void EstimatedLabels::forVisible(Bricks& bricks, const RenderedView& view, const Visit& visit) const {
  const Intrinsics& K = view.K;
  const Eigen::Isometry3f T_camera_world = view.T_world_camera.inverse().cast<float>();
  const float radius_m = cell_m_ * kSide * std::sqrt(3.0F) / 2;
  for (auto& [position, brick] : bricks) {
    const Eigen::Vector3f middle =
        T_camera_world *
        (cell_m_ * kSide * (position.template cast<float>() + Eigen::Vector3f::Constant(0.5F)));
    if (middle.z() < radius_m) continue;
    const float margin = radius_m * K.fx / (middle.z() - radius_m / 2);
    const float u0 = K.fx * middle.x() / middle.z() + K.cx, v0 = K.fy * middle.y() / middle.z() + K.cy;
    if (u0 < -margin || v0 < -margin || u0 > static_cast<float>(K.width) + margin ||
        v0 > static_cast<float>(K.height) + margin)
      continue;
    for (std::size_t cell = 0; cell < kCells; ++cell) {
      if (!brick.cells[cell].fragment) continue;
      const Eigen::Vector3f vertex = centerOf(position, cell);
      const Eigen::Vector3f p = T_camera_world * vertex;
      if (!(p.z() > 0)) continue;
      const auto u = static_cast<int>(std::lround(K.fx * p.x() / p.z() + K.cx));
      const auto v = static_cast<int>(std::lround(K.fy * p.y() / p.z() + K.cy));
      if (K.isInside(u, v)) visit(brick, brick.cells[cell], u, v, p.z(), vertex);
    }
  }
}

void EstimatedLabels::project(RenderedView& view) const {
  if (isEmpty() || view.vertices_world.empty()) return;
  const Intrinsics& K = view.K;
  std::vector<float> nearest_m(static_cast<std::size_t>(K.pixels()), 0);
  view.is_estimated.assign(nearest_m.size(), 0);
  forVisible(bricks_, view,
             [&](const Brick&, const Cell& cell, int u, int v, float z, const Eigen::Vector3f& vertex) {
               const int reach = std::max(0, static_cast<int>(std::ceil(cell_m_ * K.fx / z / 2)));
               for (int y = std::max(0, v - reach); y <= std::min(K.height - 1, v + reach); ++y) {
                 for (int x = std::max(0, u - reach); x <= std::min(K.width - 1, u + reach); ++x) {
                   const std::size_t pixel = K.indexOf(x, y);
                   const bool is_measured =
                       view.vertices_world[pixel].w() > 0 && view.is_estimated[pixel] == 0;
                   if (is_measured || (nearest_m[pixel] > 0 && nearest_m[pixel] <= z)) continue;
                   nearest_m[pixel] = z;
                   view.is_estimated[pixel] = 1;
                   view.vertices_world[pixel] << vertex, 1;
                   view.fragments[pixel] = cell.fragment;
                 }
               }
             });
}

void EstimatedLabels::update(const RenderedView& view, std::span<const FragmentId> fragments) {
  const Intrinsics& K = view.K;
  const CameraDepth depth(view.T_world_camera);
  if (!isEmpty()) {
    forVisible(bricks_, view, [&](Brick& brick, Cell& cell, int u, int v, float z, const Eigen::Vector3f&) {
      const std::size_t pixel = K.indexOf(u, v);
      const bool is_measured =
          view.vertices_world[pixel].w() > 0 && (view.is_estimated.empty() || view.is_estimated[pixel] == 0);
      if (!is_measured || depth(view.vertices_world[pixel]) < z - kThrough_m) return;
      count(cell.fragment, -1);
      cell = {};
      --brick.used;
    });
    std::erase_if(bricks_, [](const auto& entry) { return entry.second.used == 0; });
  }
  if (view.is_estimated.empty()) return;
  for (std::size_t pixel = 0; pixel < fragments.size(); ++pixel) {
    if (view.is_estimated[pixel] != 0 && fragments[pixel])
      set(view.vertices_world[pixel].head<3>(), fragments[pixel]);
  }
}

void EstimatedLabels::set(const Eigen::Vector3f& vertex_world, FragmentId fragment) {
  const Eigen::Vector3i at = (vertex_world / cell_m_).array().floor().cast<int>();
  const Eigen::Vector3i position(at.x() >> kShift, at.y() >> kShift, at.z() >> kShift);
  const Eigen::Vector3i inside = at - kSide * position;
  Brick& brick = bricks_[position];
  const int index = inside.x() + kSide * (inside.y() + kSide * inside.z());
  Cell& cell = brick.cells[static_cast<std::size_t>(index)];
  if (cell.fragment == fragment) {
    cell.confidence = static_cast<std::uint8_t>(std::min(cell.confidence + 1, kMaxConfidence));
    return;
  }
  if (cell.fragment && --cell.confidence > 0) return;
  if (cell.fragment) {
    count(cell.fragment, -1);
  } else {
    ++brick.used;
  }
  count(fragment, 1);
  cell = {fragment, 1};
}

void EstimatedLabels::count(FragmentId fragment, int more) {
  if (fragment.value >= counts_.size()) counts_.resize(fragment.value + std::size_t{1}, 0);
  counts_[fragment.value] += more;
}

}  // namespace scantrove
