#include "ui/scene/cloud_chunks.h"

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace scantrove {
namespace {

constexpr float kMiddleRadius = 0.4F;    ///< radius of the middle of the view, in half heights
constexpr float kMaxVoxelsInMiddle = 3;  ///< largest block size there, in voxels
constexpr float kSmallBlock_px = 6;      ///< smaller blocks are not visible
constexpr float kMaxOfBudget = 0.6F;     ///< for selected regions; larger ones are drawn like the rest
constexpr std::size_t kUrgentTimes = 2;  ///< factor of the budget for chunks that the user waits for

std::size_t coarsestWithin(float voxels) {
  std::size_t level = 0;
  while (level + 1 < kLevelStride.size() && static_cast<float>(kLevelStride[level + 1]) <= voxels * voxels) {
    ++level;
  }
  return level;
}

/// Distance of the box from the middle of the view, in half heights of the view.
float fromMiddle(const SplatView& view, const Eigen::AlignedBox3f& box, int height_px) {
  const Eigen::Vector3f offset = box.center() - view.eye;
  const float ahead = -offset.dot(view.back);
  const float radius = 0.5F * box.diagonal().norm();
  if (ahead <= radius) return offset.norm() <= radius ? 0.0F : 1.0F;
  const float lateral = Eigen::Vector2f(offset.dot(view.right), offset.dot(view.up)).norm();
  const float half_height = static_cast<float>(height_px) / (2 * view.pixels_per_meter_at_1m);
  return std::max(0.0F, lateral - radius) / (ahead * half_height);
}

int floorDivide(int a, int b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

/// Whether the box may intersect the view frustum; distances to its planes are positive inside.
bool mayBeVisible(const std::array<double, 24>& planes, const Eigen::AlignedBox3f& box) {
  for (std::size_t i = 0; i < 6; ++i) {
    const Eigen::Vector3d normal(planes[4 * i], planes[4 * i + 1], planes[4 * i + 2]);
    Eigen::Vector3d corner;
    for (int axis = 0; axis < 3; ++axis) corner[axis] = normal[axis] >= 0 ? box.max()[axis] : box.min()[axis];
    if (normal.dot(corner) + planes[4 * i + 3] < 0) return false;
  }
  return true;
}

}  // namespace

CloudChunks::CloudChunks(vtkRenderer* renderer) : renderer_(renderer) {}
CloudChunks::~CloudChunks() = default;

void CloudChunks::clear() {
  chunks_.clear();
  region_of_fragment_.clear();
  bounds_.setEmpty();
  point_count_ = 0;
  drawn_point_count_ = 0;
}

void CloudChunks::update(std::span<const CloudBrick> changed,
                         const std::vector<RegionChange>& changed_regions) {
  recolor(changed_regions);
  std::ptrdiff_t growth = 0;
  for (const CloudBrick& brick : changed) {
    const ChunkKey key{floorDivide(brick.position.x(), kChunkBricks),
                       floorDivide(brick.position.y(), kChunkBricks),
                       floorDivide(brick.position.z(), kChunkBricks)};
    std::unique_ptr<CloudChunk>& chunk = chunks_[key];
    if (chunk == nullptr) chunk = std::make_unique<CloudChunk>(renderer_);
    growth += chunk->setBrick(brick, voxel_size_m_);
    bounds_.extend(chunk->bounds());
  }
  point_count_ = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(point_count_) + growth);
}

void CloudChunks::recolor(const std::vector<RegionChange>& changes) {
  std::vector<bool> changed, by_person;
  for (const auto& [fragment, region, is_by_person] : changes) {
    if (fragment.value >= region_of_fragment_.size())
      region_of_fragment_.resize(fragment.value + std::size_t{1});
    RegionId& known = region_of_fragment_[fragment.value];
    if (known == region) continue;
    known = region;
    changed.resize(region_of_fragment_.size(), false);
    changed[fragment.value] = true;
    if (!is_by_person) continue;
    by_person.resize(region_of_fragment_.size(), false);
    by_person[fragment.value] = true;
  }
  if (changed.empty()) return;
  for (auto& [key, chunk] : chunks_) {
    chunk->resetSelected();
    if (!by_person.empty()) chunk->markDirtyIfUses(by_person, true);
    chunk->markDirtyIfUses(changed);
  }
}

void CloudChunks::chooseLevels(vtkCamera* camera, int width_px, int height_px, std::size_t point_budget) {
  std::array<double, 24> planes{};
  camera->GetFrustumPlanes(static_cast<double>(width_px) / std::max(1, height_px), planes.data());
  const SplatView view(camera, height_px);

  struct Candidate {
    CloudChunk* chunk;
    float spacing_px;      ///< of points of the finest level, at the chunk's near side
    float from_middle;     ///< distance in half heights of the view
    std::size_t coarsest;  ///< coarsest level allowed
    bool is_selected;
  };
  const std::size_t fine = coarsestWithin(kMaxVoxelsInMiddle);
  std::vector<Candidate> visible;
  std::size_t selected_points = 0;
  for (auto& [key, chunk] : chunks_) {
    const bool inside = chunk->pointCount() > 0 && mayBeVisible(planes, chunk->bounds());
    chunk->show(inside);
    if (!inside) continue;
    const float distance =
        std::max(0.2F, std::sqrt(chunk->bounds().squaredExteriorDistance(view.eye)) + 0.3F);
    const float spacing_px = view.pixels_per_meter_at_1m * voxel_size_m_ / distance;
    const float from_middle = fromMiddle(view, chunk->bounds(), height_px);
    const bool blocks = from_middle < kMiddleRadius && kMaxVoxelsInMiddle * spacing_px > kSmallBlock_px;
    const bool is_selected = chunk->hasSelected(selected_, region_of_fragment_);
    selected_points += is_selected ? chunk->pointCount(fine) : 0;
    visible.push_back(
        {chunk.get(), spacing_px, from_middle, blocks ? fine : kLevelStride.size() - 1, is_selected});
  }

  // Finds the smallest gap in pixels between drawn points that fits the budget. The middle of the view gets
  // half of that gap and no visible blocks, unless only they fit.
  const bool draws_selected_finely =
      selected_points <= static_cast<std::size_t>(kMaxOfBudget * static_cast<float>(point_budget));
  constexpr std::array<float, 9> kGaps_px{1.6F, 2.4F, 3.4F, 4.8F, 7, 10, 16, 1e9F, 2e9F};
  for (const float gap_px : kGaps_px) {
    drawn_point_count_ = 0;
    for (const Candidate& candidate : visible) {
      const float max_gap_px = gap_px * (0.5F + 0.5F * std::min(1.0F, candidate.from_middle));
      std::size_t coarsest = gap_px > 1e9F ? kLevelStride.size() - 1 : candidate.coarsest;
      if (candidate.is_selected && draws_selected_finely) coarsest = fine;
      std::size_t level = 0;
      while (level < coarsest &&
             candidate.spacing_px * std::sqrt(static_cast<float>(kLevelStride[level + 1])) <= max_gap_px) {
        ++level;
      }
      candidate.chunk->setLevel(level);
      drawn_point_count_ += candidate.chunk->pointCount(level);
    }
    if (drawn_point_count_ <= point_budget) break;
  }
  for (const Candidate& candidate : visible) candidate.chunk->setView(view, overlap_, voxel_size_m_);
}

bool CloudChunks::prepare(vtkCamera* camera, int width_px, int height_px, std::size_t point_budget,
                          std::size_t rebuild_budget) {
  chooseLevels(camera, width_px, height_px, point_budget);
  std::vector<CloudChunk*> dirty;
  for (auto& [key, chunk] : chunks_) {
    if (!chunk->inView() || !chunk->dirty()) continue;
    ++chunk->waiting_rounds;
    dirty.push_back(chunk.get());
  }
  // Order: chunks that the user changed, chunks never shown, then the longest waiting, so that none starves.
  std::sort(dirty.begin(), dirty.end(), [](const CloudChunk* a, const CloudChunk* b) {
    if (a->urgent() != b->urgent()) return a->urgent();
    if (a->shown() != b->shown()) return !a->shown();
    return a->waiting_rounds > b->waiting_rounds;
  });
  std::size_t spent = 0;
  for (CloudChunk* chunk : dirty) {
    const std::size_t budget = (chunk->urgent() ? kUrgentTimes : 1) * rebuild_budget;
    if (spent > 0 && spent + chunk->pointCount(chunk->level()) > budget) return false;
    chunk->rebuild(region_of_fragment_, style_, voxel_size_m_);
    chunk->waiting_rounds = 0;
    spent += chunk->pointCount(chunk->level());
  }
  if (!dirty.empty()) chooseLevels(camera, width_px, height_px, point_budget);  // for the new chunks
  return true;
}

std::map<vtkProp*, std::size_t> CloudChunks::divide(std::size_t points) const {
  std::map<vtkProp*, std::size_t> part_of;
  std::size_t part = 0, in_part = 0;
  for (const auto& [key, chunk] : chunks_) {
    if (!chunk->inView() || !chunk->shown()) continue;
    const std::size_t count = chunk->pointCount(chunk->level());
    if (in_part > 0 && in_part + count > points) {
      ++part;
      in_part = 0;
    }
    in_part += count;
    part_of[chunk->prop()] = part;
  }
  return part_of;
}

void CloudChunks::addTo(CloudIds& ids, IdDetail detail) const {
  for (const auto& [key, chunk] : chunks_)
    chunk->addTo(ids, region_of_fragment_, style_, voxel_size_m_, detail);
}

RegionId CloudChunks::regionOf(FragmentId fragment) const {
  return fragment.value < region_of_fragment_.size() ? region_of_fragment_[fragment.value] : RegionId{};
}

std::map<RegionId, std::vector<AppearancePoint>> CloudChunks::pointsOfRegions(std::size_t least) const {
  std::vector<std::vector<AppearancePoint>> of_fragment(region_of_fragment_.size());
  for (const auto& [key, chunk] : chunks_) chunk->collectPoints(of_fragment);
  std::map<RegionId, std::vector<AppearancePoint>> of_region;
  for (std::size_t fragment = 1; fragment < of_fragment.size(); ++fragment) {
    if (!region_of_fragment_[fragment] || of_fragment[fragment].empty()) continue;
    std::vector<AppearancePoint>& points = of_region[region_of_fragment_[fragment]];
    points.insert(points.end(), of_fragment[fragment].begin(), of_fragment[fragment].end());
  }
  std::erase_if(of_region, [least](const auto& entry) { return entry.second.size() < least; });
  return of_region;
}

bool CloudChunks::upToDate() const {
  return std::none_of(chunks_.begin(), chunks_.end(),
                      [](const auto& entry) { return entry.second->inView() && entry.second->dirty(); });
}

std::vector<Eigen::Vector3f> CloudChunks::brickNormals() const {
  std::vector<Eigen::Vector3f> normals;
  for (const auto& [key, chunk] : chunks_) chunk->collectNormals(normals);
  return normals;
}

float CloudChunks::heightAbove(const Eigen::Vector3f& up, float part) const {
  std::vector<float> heights;
  for (const auto& [key, chunk] : chunks_) chunk->collectHeights(up, heights);
  if (heights.empty()) return 0;
  const auto last = static_cast<float>(heights.size() - 1);
  const auto quantile = heights.begin() + static_cast<std::ptrdiff_t>(part * last);
  std::nth_element(heights.begin(), quantile, heights.end());
  return *quantile;
}

std::optional<Eigen::Vector3f> CloudChunks::pick(const Eigen::Vector3f& origin,
                                                 const Eigen::Vector3f& direction,
                                                 float radians_per_pixel) const {
  std::vector<PickedPoint> found;
  const PickRay ray(origin, direction, voxel_size_m_, radians_per_pixel);
  for (const auto& [key, chunk] : chunks_)
    chunk->collectNear(ray, region_of_fragment_, style_, voxel_size_m_, found);
  return foremost(found, 2 * voxel_size_m_);
}

Eigen::AlignedBox3f CloudChunks::boundsOf(const std::set<RegionId>& regions) const {
  Eigen::AlignedBox3f box;
  for (const auto& [key, chunk] : chunks_)
    chunk->extendByRegions(regions, region_of_fragment_, voxel_size_m_, box);
  return box;
}

void CloudChunks::setColoring(Coloring coloring) {
  if (coloring == style_.coloring) return;
  style_.coloring = coloring;
  recolorAll();
}

void CloudChunks::setSelected(const std::set<RegionId>& regions) {
  if (regions == selected_) return;
  selected_ = regions;
  for (auto& [key, chunk] : chunks_) chunk->resetSelected();
}

void CloudChunks::setBackground(const std::set<RegionId>& regions, BackgroundStyle style) {
  const std::set<RegionId> before = std::exchange(style_.background, regions);
  const BackgroundStyle style_before = std::exchange(style_.background_style, style);
  if (style != style_before) {
    recolorRegions([&](RegionId region) { return before.contains(region) || regions.contains(region); });
  } else if (before != regions && style != BackgroundStyle::as_others) {
    recolorRegions([&](RegionId region) { return before.contains(region) != regions.contains(region); });
  }
}

void CloudChunks::setBackdrop(const Rgb& color) {
  if (color == style_.backdrop) return;
  style_.backdrop = color;
  if (style_.background_style == BackgroundStyle::dimmed)
    recolorRegions([&](RegionId region) { return style_.isBackground(region); });
}

void CloudChunks::setHeights(const Eigen::Vector3f& up, float low_m, float high_m) {
  style_.up = up;
  style_.low_m = low_m;
  style_.high_m = high_m;
  if (style_.coloring == Coloring::height || style_.coloring == Coloring::normals) recolorAll();
}

void CloudChunks::recolorAll() {
  for (auto& [key, chunk] : chunks_) chunk->markAll();
}

template <class Changed>
void CloudChunks::recolorRegions(const Changed& changed) {
  std::vector<bool> fragments(region_of_fragment_.size());
  for (std::size_t i = 0; i < fragments.size(); ++i) fragments[i] = changed(region_of_fragment_[i]);
  for (auto& [key, chunk] : chunks_) chunk->markDirtyIfUses(fragments);
}

}  // namespace scantrove
