#include "ui/scene/cloud_chunk.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

namespace scantrove {
namespace {

constexpr float kOwnLight = 0.6F;  ///< share of the light from the point's own normal

/// The coarsest level that draws the point. Level n draws the voxels whose x + 7 y + 11 z is divisible by
/// kLevelStride[n]. Each level is a subset of the finer ones and nearly even on surfaces of any direction.
std::size_t coarsestLevel(const CloudBrick::Point& p, float per_meter) {
  // Valid for points at voxel centres and corners.
  const auto voxel = [per_meter](float meters) {
    return static_cast<unsigned>(static_cast<int>(std::floor(meters * per_meter + 0.25F)));
  };
  const unsigned position = voxel(p.x) + 7 * voxel(p.y) + 11 * voxel(p.z);
  std::size_t level = kLevelStride.size() - 1;
  while (position % kLevelStride[level] != 0) --level;
  return level;
}

/// Sorts the points, those of coarser levels first. Sets `count` to the number of points per level.
std::vector<CloudBrick::Point> inOrderOfLevels(const std::vector<CloudBrick::Point>& points, float per_meter,
                                               LevelCounts& count) {
  std::vector<std::size_t> levels;
  levels.reserve(points.size());
  count.fill(0);
  for (const CloudBrick::Point& p : points) {
    levels.push_back(coarsestLevel(p, per_meter));
    for (std::size_t level = 0; level <= levels.back(); ++level) ++count[level];
  }
  std::vector<CloudBrick::Point> ordered(points.size());
  LevelCounts next{};
  for (std::size_t level = 0; level + 1 < next.size(); ++level) next[level] = count[level + 1];
  for (std::size_t i = 0; i < points.size(); ++i) ordered[next[levels[i]]++] = points[i];
  return ordered;
}

RegionId regionOf(FragmentId fragment, const CloudChunk::RegionOfFragment& region_of_fragment) {
  const bool known = fragment.value < region_of_fragment.size();
  return known ? region_of_fragment[fragment.value] : RegionId{};
}
RegionId regionOf(const CloudBrick::Point& point, const CloudChunk::RegionOfFragment& region_of_fragment) {
  return regionOf(point.fragment, region_of_fragment);
}

std::vector<FragmentId> fragmentsOf(const std::vector<CloudBrick::Point>& points) {
  std::vector<FragmentId> fragments;
  for (const CloudBrick::Point& p : points) {
    if (fragments.empty() || fragments.back() != p.fragment) fragments.push_back(p.fragment);
  }
  std::ranges::sort(fragments);
  fragments.erase(std::unique(fragments.begin(), fragments.end()), fragments.end());
  return fragments;
}

/// Copies values as triples.
template <class Array, class Value>
void copyInto(const std::vector<Value>& values, Array& array) {
  array.SetNumberOfComponents(3);
  array.SetNumberOfTuples(static_cast<vtkIdType>(values.size() / 3));
  std::copy(values.begin(), values.end(), array.GetPointer(0));
}

}  // namespace

CloudChunk::CloudChunk(vtkRenderer* renderer)
    : renderer_(renderer),
      actor_(vtkSmartPointer<vtkActor>::New()),
      mapper_(vtkSmartPointer<vtkOpenGLPolyDataMapper>::New()) {
  mapper_->SetScalarModeToUsePointData();
  mapper_->SetColorModeToDirectScalars();
  // Positions need no normalising: chunks are small, and near the origin compared with float precision.
  mapper_->SetVBOShiftScaleMethod(0);
  actor_->SetMapper(mapper_);
  actor_->GetProperty()->LightingOff();
  actor_->GetProperty()->SetPointSize(3);
  actor_->PickableOff();
  drawAsSplats(actor_, overlap_);
  actor_->VisibilityOff();
  renderer_->AddActor(actor_);
}

CloudChunk::~CloudChunk() { renderer_->RemoveActor(actor_); }

CloudBrick::Point CloudChunk::Brick::shown(std::size_t point) const {
  CloudBrick::Point shown = points[point];
  if (point < smooth.size()) shown.normal = smooth[point];
  return shown;
}

std::ptrdiff_t CloudChunk::setBrick(const CloudBrick& brick, float voxel_size_m) {
  Brick& stored = bricks_[{brick.position.x(), brick.position.y(), brick.position.z()}];
  if (stored.version > brick.version) return 0;
  const auto growth =
      static_cast<std::ptrdiff_t>(brick.points.size()) - static_cast<std::ptrdiff_t>(stored.points.size());
  stored.version = brick.version;
  if (hasSameAppearance(stored.points, brick.points, voxel_size_m)) return 0;
  for (std::size_t level = 0; level < kLevelStride.size(); ++level) count_[level] -= stored.count[level];
  stored.points = inOrderOfLevels(brick.points, 1 / voxel_size_m, stored.count);
  stored.fragments = fragmentsOf(stored.points);
  stored.smooth.clear();
  spreadColors(stored.points, voxel_size_m);
  for (std::size_t level = 0; level < kLevelStride.size(); ++level) count_[level] += stored.count[level];
  // Normals are expensive, and a surface with an equal number of points keeps its shape.
  const auto shaped = static_cast<std::ptrdiff_t>(stored.points_when_shaped);
  if (10 * std::abs(static_cast<std::ptrdiff_t>(brick.points.size()) - shaped) > shaped) {
    stored.points_when_shaped = brick.points.size();
    stored.normals = cellNormals(brick, voxel_size_m);
    resetLightAround({brick.position.x(), brick.position.y(), brick.position.z()});
  }
  for (const CloudBrick::Point& p : brick.points) bounds_.extend(Eigen::Vector3f(p.x, p.y, p.z));
  dirty_ = true;
  urgent_ = urgent_ || brick.by_person;
  resetSelected();
  return growth;
}

void CloudChunk::markDirtyIfUses(const std::vector<bool>& changed, bool urgently) {
  if (dirty_ && (urgent_ || !urgently)) return;
  for (const auto& [key, brick] : bricks_) {
    for (const FragmentId fragment : brick.fragments) {
      if (fragment.value < changed.size() && changed[fragment.value]) {
        dirty_ = true;
        urgent_ = urgent_ || urgently;
        return;
      }
    }
  }
}

bool CloudChunk::hasSelected(const std::set<RegionId>& selected, const RegionOfFragment& region_of_fragment) {
  if (selected.empty()) return false;
  if (has_selected_) return *has_selected_;
  const auto isSelected = [&](FragmentId fragment) {
    return selected.contains(regionOf(fragment, region_of_fragment));
  };
  has_selected_ = std::ranges::any_of(
      bricks_, [&](const auto& brick) { return std::ranges::any_of(brick.second.fragments, isSelected); });
  return *has_selected_;
}

void CloudChunk::setLevel(std::size_t level) { target_level_ = level; }

void CloudChunk::show(bool visible) {
  in_view_ = visible;
  actor_->SetVisibility(visible && shown());
}

void CloudChunk::rebuild(const RegionOfFragment& region_of_fragment, const CloudStyle& style,
                         float voxel_size_m) {
  const std::size_t max_points = pointCount(target_level_);
  std::vector<float> positions, directions;
  std::vector<unsigned char> rgb;
  positions.reserve(3 * max_points);
  directions.reserve(3 * max_points);
  rgb.reserve(3 * max_points);
  const float brick_m = 8 * voxel_size_m;
  for (auto& [key, brick] : bricks_) {
    if (brick.count[target_level_] == 0) continue;
    if (!brick.light) brick.light = lightOf(key);
    const std::size_t drawn = brick.count[target_level_];
    if (brick.smooth.size() < drawn) brick.smooth = smoothNormals(brick.points, drawn, voxel_size_m);
    const Eigen::Vector3f corner = Eigen::Vector3i(key.x, key.y, key.z).cast<float>();
    for (std::size_t i = 0; i < drawn; ++i) {
      const CloudBrick::Point p = brick.shown(i);
      const RegionId region = regionOf(p, region_of_fragment);
      if (style.hides(region)) continue;
      const Eigen::Vector3f normal = p.normal.unpacked();
      const Eigen::Vector3f position = p.onSurface(voxel_size_m);
      // The brick's light is smooth; the light of the normal shows small shapes.
      float light = lightAt(*brick.light, position / brick_m - corner);
      if (p.normal.known()) light += kOwnLight * (lightOn(normal) - light);
      positions.insert(positions.end(), position.data(), position.data() + 3);
      directions.insert(directions.end(), normal.data(), normal.data() + 3);
      const Rgb color = pointColor(style, p, region, light);
      rgb.insert(rgb.end(), color.begin(), color.end());
    }
  }
  const auto count = static_cast<vtkIdType>(rgb.size() / 3);
  const auto position_array = vtkSmartPointer<vtkFloatArray>::New();
  const auto normal_array = vtkSmartPointer<vtkFloatArray>::New();
  const auto color_array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  copyInto(positions, *position_array);
  copyInto(directions, *normal_array);
  copyInto(rgb, *color_array);

  // One cell holds all points.
  const auto ids = vtkSmartPointer<vtkIdTypeArray>::New();
  ids->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i) ids->SetValue(i, i);
  const auto offsets = vtkSmartPointer<vtkIdTypeArray>::New();
  offsets->SetNumberOfTuples(2);
  offsets->SetValue(0, 0);
  offsets->SetValue(1, count);
  const auto vertices = vtkSmartPointer<vtkCellArray>::New();
  vertices->SetData(offsets, ids);

  const auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(position_array);
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  if (count > 0) data->SetVerts(vertices);
  data->GetPointData()->SetScalars(color_array);
  data->GetPointData()->SetNormals(normal_array);
  mapper_->SetInputData(data);
  built_level_ = target_level_;
  dirty_ = false;
  urgent_ = false;
}

void CloudChunk::resetLightAround(const BrickKey& key) {
  for (int i = 0; i < 27; ++i) {
    const auto found = bricks_.find({key.x + i % 3 - 1, key.y + i / 3 % 3 - 1, key.z + i / 9 - 1});
    if (found != bricks_.end()) found->second.light.reset();
  }
}

CellLight CloudChunk::lightOf(const BrickKey& key) const {
  Neighborhood around{};
  for (int i = 0; i < 27; ++i) {
    const auto found = bricks_.find({key.x + i % 3 - 1, key.y + i / 3 % 3 - 1, key.z + i / 9 - 1});
    if (found != bricks_.end()) around[static_cast<std::size_t>(i)] = &found->second.normals;
  }
  return cellLight(around);
}

CloudChunk::Disc CloudChunk::discOf(std::size_t level, float voxel_size_m) {
  // A level with every n-th point of a surface needs discs sqrt(n) times as wide to close gaps. Points of
  // coarser levels are less even.
  const float width = level == 0 ? 1.9F : 2.2F;
  return {width * std::sqrt(static_cast<float>(kLevelStride[level])) * voxel_size_m,
          level == 0 ? 1.6F : 2.0F};
}

void CloudChunk::setView(const SplatView& view, SplatOverlap overlap, float voxel_size_m) {
  if (overlap != overlap_) drawAsSplats(actor_, overlap);
  overlap_ = overlap;
  const auto [diameter_m, least_px] = discOf(shown() ? built_level_ : 0, voxel_size_m);
  setSplats(actor_, view, diameter_m, least_px);
}

void CloudChunk::addTo(CloudIds& ids, const RegionOfFragment& region_of_fragment, const CloudStyle& style,
                       float voxel_size_m, IdDetail detail) const {
  if (!in_view_ || !shown() || !ids.maySee(bounds_)) return;
  const std::size_t level = detail == IdDetail::drawn ? built_level_ : 0;
  const auto [diameter_m, least_px] = discOf(level, voxel_size_m);
  ids.setDisc(diameter_m, least_px);
  const float brick_m = 8 * voxel_size_m;
  for (const auto& [key, brick] : bricks_) {
    const Eigen::Vector3f corner = brick_m * Eigen::Vector3i(key.x, key.y, key.z).cast<float>();
    if (!ids.maySee({corner, corner.array() + brick_m})) continue;
    for (std::size_t i = 0; i < brick.count[level]; ++i) {
      const CloudBrick::Point p = brick.shown(i);
      if (!style.hides(regionOf(p, region_of_fragment)))
        ids.add(p.onSurface(voxel_size_m), p.normal.unpacked(), p.fragment);
    }
  }
}

void CloudChunk::collectNear(const PickRay& ray, const RegionOfFragment& region_of_fragment,
                             const CloudStyle& style, float voxel_size_m,
                             std::vector<PickedPoint>& found) const {
  if (!ray.mayIntersect(bounds_)) return;
  for (const auto& [key, brick] : bricks_) {
    if (brick.points.empty()) continue;
    const Eigen::Vector3f corner = Eigen::Vector3i(key.x, key.y, key.z).cast<float>();
    const float brick_m = 8 * voxel_size_m;
    if (!ray.mayIntersect({corner * brick_m, (corner.array() + 1).matrix() * brick_m})) continue;
    for (std::size_t i = 0; i < brick.points.size(); ++i) {
      const CloudBrick::Point p = brick.shown(i);
      const Eigen::Vector3f position = p.onSurface(voxel_size_m);
      const std::optional<PickedPoint> picked = ray.intersect(position);
      if (picked && !style.hides(regionOf(p, region_of_fragment))) found.push_back(*picked);
    }
  }
}

void CloudChunk::extendByRegions(const std::set<RegionId>& regions,
                                 const RegionOfFragment& region_of_fragment, float voxel_size_m,
                                 Eigen::AlignedBox3f& box) const {
  for (const auto& [key, brick] : bricks_) {
    for (const CloudBrick::Point& p : brick.points) {
      if (regions.contains(regionOf(p, region_of_fragment))) box.extend(p.onSurface(voxel_size_m));
    }
  }
}

void CloudChunk::collectNormals(std::vector<Eigen::Vector3f>& normals) const {
  for (const auto& [key, brick] : bricks_) {
    const Eigen::Vector3f normal = mainNormal(brick.normals);
    if (normal.squaredNorm() > 0) normals.push_back(normal);
  }
}

void CloudChunk::collectPoints(std::vector<std::vector<AppearancePoint>>& of_fragment) const {
  for (const auto& [key, brick] : bricks_) {
    for (const CloudBrick::Point& p : brick.points) {
      if (p.fragment.value < of_fragment.size())
        of_fragment[p.fragment.value].push_back(
            {{p.x, p.y, p.z}, p.color.rgb, p.color.known(), p.normal.unpacked()});
    }
  }
}

void CloudChunk::collectHeights(const Eigen::Vector3f& up, std::vector<float>& heights) const {
  for (const auto& [key, brick] : bricks_) {
    if (brick.points.empty()) continue;
    const CloudBrick::Point& p = brick.points.front();
    heights.push_back(up.dot(Eigen::Vector3f(p.x, p.y, p.z)));
  }
}

}  // namespace scantrove
