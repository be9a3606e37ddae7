#include "ui/scene/cloud_chunk.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

#include "core/exchange/region_palette.h"

namespace scantrove {
namespace {

/// The coarsest level that shows the point. The points of level n are a lattice of every kLevelStride[n]-th
/// voxel, x + 7 y + 11 z divisible by it: each lies within the finer one, and all lie nearly evenly on
/// surfaces across any axis.
std::size_t coarsestLevel(const CloudBrick::Point& p, float per_metre) {
  // Right for points at voxel centres and at their corners.
  const auto voxel = [per_metre](float metres) {
    return static_cast<unsigned>(static_cast<int>(std::floor(metres * per_metre + 0.25F)));
  };
  const unsigned place = voxel(p.x) + 7 * voxel(p.y) + 11 * voxel(p.z);
  std::size_t level = kLevelStride.size() - 1;
  while (place % kLevelStride[level] != 0) --level;
  return level;
}

/// The points, those of coarser levels first; `count` becomes how many each level shows.
std::vector<CloudBrick::Point> inOrderOfLevels(const std::vector<CloudBrick::Point>& points, float per_metre,
                                               LevelCounts& count) {
  std::vector<std::size_t> levels;
  levels.reserve(points.size());
  count.fill(0);
  for (const CloudBrick::Point& p : points) {
    levels.push_back(coarsestLevel(p, per_metre));
    for (std::size_t level = 0; level <= levels.back(); ++level) ++count[level];
  }
  std::vector<CloudBrick::Point> ordered(points.size());
  LevelCounts next{};
  for (std::size_t level = 0; level + 1 < next.size(); ++level) next[level] = count[level + 1];
  for (std::size_t i = 0; i < points.size(); ++i) ordered[next[levels[i]]++] = points[i];
  return ordered;
}

}  // namespace

CloudChunk::CloudChunk(vtkRenderer* renderer)
    : renderer_(renderer),
      actor_(vtkSmartPointer<vtkActor>::New()),
      mapper_(vtkSmartPointer<vtkOpenGLPolyDataMapper>::New()) {
  mapper_->SetScalarModeToUsePointData();
  mapper_->SetColorModeToDirectScalars();
  // Positions need no normalising: chunks are small and near the origin compared with float precision.
  mapper_->SetVBOShiftScaleMethod(0);
  actor_->SetMapper(mapper_);
  actor_->GetProperty()->LightingOff();
  actor_->GetProperty()->SetPointSize(3);
  actor_->PickableOff();
  // Points grow towards the viewer, so that a surface closes from near and stays fine from afar.
  actor_->GetShaderProperty()->AddVertexShaderReplacement(
      "//VTK::PositionVC::Impl", true,
      "//VTK::PositionVC::Impl\n"
      "  gl_PointSize = clamp(point_scale / gl_Position.w, point_minimum, 40.0);\n",
      false);
  actor_->VisibilityOff();
  setPointScale(5);
  renderer_->AddActor(actor_);
}

CloudChunk::~CloudChunk() { renderer_->RemoveActor(actor_); }

std::ptrdiff_t CloudChunk::setBrick(const CloudBrick& brick, float voxel_size_m) {
  Brick& mine = bricks_[{brick.position.x(), brick.position.y(), brick.position.z()}];
  if (mine.version > brick.version) return 0;
  const auto growth =
      static_cast<std::ptrdiff_t>(brick.points.size()) - static_cast<std::ptrdiff_t>(mine.points.size());
  mine.version = brick.version;
  for (std::size_t level = 0; level < kLevelStride.size(); ++level) count_[level] -= mine.count[level];
  mine.points = inOrderOfLevels(brick.points, 1 / voxel_size_m, mine.count);
  for (std::size_t level = 0; level < kLevelStride.size(); ++level) count_[level] += mine.count[level];
  // Normals are dear, and a surface that gains no points keeps its shape.
  const auto shaped = static_cast<std::ptrdiff_t>(mine.points_when_shaped);
  if (10 * std::abs(static_cast<std::ptrdiff_t>(brick.points.size()) - shaped) > shaped) {
    mine.points_when_shaped = brick.points.size();
    mine.normals = cellNormals(brick, voxel_size_m);
    relightAround({brick.position.x(), brick.position.y(), brick.position.z()});
  }
  for (const CloudBrick::Point& p : brick.points) bounds_.extend(Eigen::Vector3f(p.x, p.y, p.z));
  dirty_ = true;
  return growth;
}

void CloudChunk::markIfUses(const std::vector<bool>& changed) {
  if (dirty_) return;
  for (const auto& [key, brick] : bricks_) {
    for (const CloudBrick::Point& p : brick.points) {
      if (p.fragment.value < changed.size() && changed[p.fragment.value]) {
        dirty_ = true;
        return;
      }
    }
  }
}

void CloudChunk::setLevel(std::size_t level) { wanted_level_ = level; }

void CloudChunk::show(bool visible) {
  in_view_ = visible;
  actor_->SetVisibility(visible && shown());
}

void CloudChunk::rebuild(const RegionOfFragment& region_of_fragment, float voxel_size_m) {
  const auto count = static_cast<vtkIdType>(pointCount(wanted_level_));
  const auto positions = vtkSmartPointer<vtkFloatArray>::New();
  positions->SetNumberOfComponents(3);
  positions->SetNumberOfTuples(count);
  const auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(count);
  float* position = positions->GetPointer(0);
  unsigned char* color = colors->GetPointer(0);

  const float brick_m = 8 * voxel_size_m;
  for (auto& [key, brick] : bricks_) {
    if (brick.count[wanted_level_] == 0) continue;
    if (!brick.light) brick.light = lightOf(key);
    const Eigen::Vector3f corner = Eigen::Vector3i(key.x, key.y, key.z).cast<float>();
    for (const CloudBrick::Point& p : std::span(brick.points).first(brick.count[wanted_level_])) {
      for (const float coordinate : {p.x, p.y, p.z}) *position++ = coordinate;
      const bool known = p.fragment.value < region_of_fragment.size();
      const RegionId region = known ? region_of_fragment[p.fragment.value] : RegionId{};
      const float shade = lightAt(*brick.light, Eigen::Vector3f(p.x, p.y, p.z) / brick_m - corner);
      for (const std::uint8_t channel : regionColor(region)) {
        *color++ = static_cast<unsigned char>(shade * static_cast<float>(channel));
      }
    }
  }

  // One cell that lists all points.
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
  points->SetData(positions);
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetVerts(vertices);
  data->GetPointData()->SetScalars(colors);
  mapper_->SetInputData(data);
  built_level_ = wanted_level_;
  dirty_ = false;
}

void CloudChunk::relightAround(const BrickKey& key) {
  for (int i = 0; i < 27; ++i) {
    const auto found = bricks_.find({key.x + i % 3 - 1, key.y + i / 3 % 3 - 1, key.z + i / 9 - 1});
    if (found != bricks_.end()) found->second.light.reset();
  }
}

CellLight CloudChunk::lightOf(const BrickKey& key) const {
  Neighbourhood around{};
  for (int i = 0; i < 27; ++i) {
    const auto found = bricks_.find({key.x + i % 3 - 1, key.y + i / 3 % 3 - 1, key.z + i / 9 - 1});
    if (found != bricks_.end()) around[static_cast<std::size_t>(i)] = &found->second.normals;
  }
  return cellLight(around);
}

void CloudChunk::setPointScale(float pixels_at_1m) {
  // A level with every n-th point of a surface needs squares sqrt(n) times as wide to stay closed.
  const std::size_t level = shown() ? built_level_ : 0;
  // Where the surface steps from one layer of voxels to the next, the lattices of both do not quite meet.
  const float overlap = level == 0 ? 1.5F : 1.9F;
  const float widening = overlap * std::sqrt(static_cast<float>(kLevelStride[level]));
  vtkUniforms* uniforms = actor_->GetShaderProperty()->GetVertexCustomUniforms();
  point_scale_ = pixels_at_1m * widening;
  point_minimum_ = level == 0 ? 1.6F : 2.0F;
  uniforms->SetUniformf("point_scale", point_scale_);
  uniforms->SetUniformf("point_minimum", point_minimum_);
}

void CloudChunk::addTo(CloudIds& ids) const {
  if (!in_view_ || !shown()) return;
  for (const auto& [key, brick] : bricks_) {
    for (const CloudBrick::Point& p : std::span(brick.points).first(brick.count[built_level_]))
      ids.add({p.x, p.y, p.z}, p.fragment, point_scale_, point_minimum_);
  }
}

void CloudChunk::collectNormals(std::vector<Eigen::Vector3f>& normals) const {
  for (const auto& [key, brick] : bricks_) {
    const Eigen::Vector3f normal = mainNormal(brick.normals);
    if (normal.squaredNorm() > 0) normals.push_back(normal);
  }
}

void CloudChunk::collectPoints(std::vector<std::vector<LookPoint>>& of_fragment) const {
  for (const auto& [key, brick] : bricks_) {
    for (const CloudBrick::Point& p : brick.points) {
      if (p.fragment.value < of_fragment.size())
        of_fragment[p.fragment.value].push_back({{p.x, p.y, p.z}, {}, false});
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
