#include "core/labeling/estimated_labels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/check.h"
#include "core/geometry/camera_depth.h"

namespace scantrove {
namespace {

constexpr int kMaxConfidence = 8;  // as many frames must disagree before a cell changes its fragment
/// Measured surface farther behind a cell sees through it; nearer than this it is that cell's surface.
constexpr float kThrough_m = 0.03F;
constexpr std::uint32_t kIndexBits = 16, kIndexMask = 0xffff;  // of a stored cell; its confidence lies above

}  // namespace

Eigen::Vector3i EstimatedLabels::placeOf(std::size_t cell) {
  const auto index = static_cast<int>(cell);
  return {index % kSide, index / kSide % kSide, index / (kSide * kSide)};
}

Eigen::Vector3f EstimatedLabels::centerOf(const Eigen::Vector3i& brick, std::size_t cell) const {
  return cell_m_ * ((kSide * brick + placeOf(cell)).cast<float>() + Eigen::Vector3f::Constant(0.5F));
}

void EstimatedLabels::forEach(const VisitCell& visit) const {
  for (const auto& [position, brick] : bricks_) {
    for (std::size_t cell = 0; cell < kCells; ++cell)
      if (brick.cells[cell].fragment) visit(centerOf(position, cell), brick.cells[cell].fragment);
  }
}

void EstimatedLabels::forEachIn(const Eigen::Vector3i& map_brick, const VisitCell& visit) const {
  const Eigen::Vector3i first = kMapBrickSide * map_brick;  // cell
  const Eigen::Vector3i position(first.x() >> kShift, first.y() >> kShift, first.z() >> kShift);
  const auto found = bricks_.find(position);
  if (found == bricks_.end()) return;
  const Eigen::Vector3i inside = first - kSide * position;
  for (int z = inside.z(); z < inside.z() + kMapBrickSide; ++z) {
    for (int y = inside.y(); y < inside.y() + kMapBrickSide; ++y) {
      for (int x = inside.x(); x < inside.x() + kMapBrickSide; ++x) {
        const int place = x + kSide * (y + kSide * z);
        const auto cell = static_cast<std::size_t>(place);
        const FragmentId fragment = found->second.cells[cell].fragment;
        if (fragment) visit(centerOf(position, cell), fragment);
      }
    }
  }
}

std::vector<Eigen::Vector3i> EstimatedLabels::mapBricks() const {
  std::vector<Eigen::Vector3i> bricks;
  for (const auto& [position, brick] : bricks_) {
    for (int i = 0; i < kMapBricks * kMapBricks * kMapBricks; ++i)
      bricks.emplace_back(kMapBricks * position + Eigen::Vector3i(i % kMapBricks, i / kMapBricks % kMapBricks,
                                                                  i / (kMapBricks * kMapBricks)));
  }
  return bricks;
}

std::vector<Eigen::Vector3i> EstimatedLabels::takeChangedMapBricks() {
  const auto changed = std::exchange(changed_map_bricks_, {});
  return {changed.begin(), changed.end()};
}

template <class SomeBricks, class Visit>
void EstimatedLabels::forVisible(SomeBricks& bricks, const RenderedView& view, const Visit& visit) const {
  const Intrinsics& K = view.K;
  const Eigen::Isometry3f T_camera_world = view.T_world_camera.inverse().cast<float>();
  const float radius_m = cell_m_ * kSide * std::sqrt(3.0F) / 2;
  for (auto& entry : bricks) {
    auto& [position, brick] = entry;
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
      if (K.isInside(u, v)) visit(entry, brick.cells[cell], Seen{u, v, p.z(), vertex});
    }
  }
}

void EstimatedLabels::project(RenderedView& view) const {
  if (isEmpty() || view.vertices_world.empty()) return;
  const Intrinsics& K = view.K;
  std::vector<float> nearest_m(static_cast<std::size_t>(K.pixels()), 0);
  view.is_estimated.assign(nearest_m.size(), 0);
  forVisible(bricks_, view, [&](const Bricks::value_type&, const Cell& cell, const Seen& seen) {
    const int reach = std::max(0, static_cast<int>(std::ceil(cell_m_ * K.fx / seen.z_m / 2)));
    for (int y = std::max(0, seen.v - reach); y <= std::min(K.height - 1, seen.v + reach); ++y) {
      for (int x = std::max(0, seen.u - reach); x <= std::min(K.width - 1, seen.u + reach); ++x) {
        const std::size_t pixel = K.indexOf(x, y);
        const bool is_measured = view.vertices_world[pixel].w() > 0 && view.is_estimated[pixel] == 0;
        if (is_measured || (nearest_m[pixel] > 0 && nearest_m[pixel] <= seen.z_m)) continue;
        nearest_m[pixel] = seen.z_m;
        view.is_estimated[pixel] = 1;
        view.vertices_world[pixel] << seen.vertex_world, 1;
        view.fragments[pixel] = cell.fragment;
      }
    }
  });
}

void EstimatedLabels::update(const RenderedView& view, std::span<const std::uint8_t> estimated,
                             std::span<const FragmentId> fragments) {
  const Intrinsics& K = view.K;
  const CameraDepth depth(view.T_world_camera);
  forVisible(bricks_, view, [&](Bricks::value_type& entry, Cell& cell, const Seen& seen) {
    const std::size_t pixel = K.indexOf(seen.u, seen.v);
    const bool is_measured =
        view.vertices_world[pixel].w() > 0 && (view.is_estimated.empty() || view.is_estimated[pixel] == 0);
    if (is_measured && depth(view.vertices_world[pixel]) >= seen.z_m - kThrough_m) change(entry, cell, {});
    if (!is_measured && !estimated.empty() && estimated[pixel] == 0) weaken(entry, cell);
  });
  std::erase_if(bricks_, [](const auto& entry) { return entry.second.used == 0; });
  for (std::size_t pixel = 0; pixel < estimated.size(); ++pixel) {
    if (estimated[pixel] != 0 && fragments[pixel])
      set(view.vertices_world[pixel].head<3>(), fragments[pixel]);
  }
}

void EstimatedLabels::weaken(Bricks::value_type& entry, Cell& cell) {
  const auto confidence = static_cast<std::uint8_t>(cell.confidence - 1);
  change(entry, cell, confidence > 0 ? Cell{cell.fragment, confidence} : Cell{});
}

void EstimatedLabels::set(const Eigen::Vector3f& vertex_world, FragmentId fragment) {
  const Eigen::Vector3i at = (vertex_world / cell_m_).array().floor().cast<int>();
  const Eigen::Vector3i position(at.x() >> kShift, at.y() >> kShift, at.z() >> kShift);
  const Eigen::Vector3i inside = at - kSide * position;
  const int index = inside.x() + kSide * (inside.y() + kSide * inside.z());
  Bricks::value_type& entry = *bricks_.try_emplace(position).first;
  Cell& cell = entry.second.cells[static_cast<std::size_t>(index)];
  if (cell.fragment == fragment) {
    const int confidence = std::min(cell.confidence + 1, kMaxConfidence);
    change(entry, cell, {fragment, static_cast<std::uint8_t>(confidence)});
  } else if (cell.confidence > 1) {
    weaken(entry, cell);
  } else {
    change(entry, cell, {fragment, 1});
  }
}

void EstimatedLabels::change(Bricks::value_type& entry, Cell& cell, const Cell& to) {
  if (cell == to) return;
  auto& [position, brick] = entry;
  if (!std::exchange(brick.is_changed, true)) changed_.push_back(position);
  if (cell.fragment != to.fragment) {
    const Eigen::Vector3i place = placeOf(static_cast<std::size_t>(&cell - brick.cells.data()));
    changed_map_bricks_.emplace(kMapBricks * position + place / kMapBrickSide);
  }
  if (cell.fragment) {
    --counts_[cell.fragment.value];
    --brick.used;
  }
  if (to.fragment) {
    if (to.fragment.value >= counts_.size()) counts_.resize(to.fragment.value + std::size_t{1}, 0);
    ++counts_[to.fragment.value];
    ++brick.used;
  }
  cell = to;
}

std::vector<EstimatedLabels::StoredBrick> EstimatedLabels::takeChanged() {
  std::vector<StoredBrick> stored;
  for (const Eigen::Vector3i& position : std::exchange(changed_, {})) {
    stored.push_back({position, {}});
    const auto found = bricks_.find(position);
    if (found == bricks_.end()) continue;
    found->second.is_changed = false;
    for (std::uint32_t index = 0; const Cell& cell : found->second.cells) {
      if (cell.fragment) {
        stored.back().words.push_back(index | std::uint32_t{cell.confidence} << kIndexBits);
        stored.back().words.push_back(cell.fragment.value);
      }
      ++index;
    }
  }
  return stored;
}

bool EstimatedLabels::isValid(const StoredBrick& stored) {
  if (stored.words.size() % 2 != 0) return false;
  std::int64_t last = -1;
  for (std::size_t word = 0; word < stored.words.size(); word += 2) {
    const std::uint32_t index = stored.words[word] & kIndexMask;
    const std::uint32_t confidence = stored.words[word] >> kIndexBits;
    if (index >= kCells || index <= last || confidence == 0 || confidence > kMaxConfidence) return false;
    last = index;
  }
  return true;
}

void EstimatedLabels::restore(const StoredBrick& stored, std::span<const RegionId> regions) {
  SCANTROVE_CHECK(isValid(stored));
  Bricks::value_type& entry = *bricks_.try_emplace(stored.position).first;
  entry.second.is_changed = true;  // what was just read needs no storing
  for (std::size_t word = 0; word < stored.words.size(); word += 2) {
    const FragmentId fragment{stored.words[word + 1]};
    if (fragment.value >= regions.size() || !regions[fragment.value]) continue;
    change(entry, entry.second.cells[stored.words[word] & kIndexMask],
           {fragment, static_cast<std::uint8_t>(stored.words[word] >> kIndexBits)});
  }
  entry.second.is_changed = false;
  if (entry.second.used == 0) bricks_.erase(stored.position);
}

}  // namespace scantrove
