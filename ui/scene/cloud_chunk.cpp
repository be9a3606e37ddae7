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

#include "core/exchange/region_palette.h"

namespace scantrove {
namespace {

/// Whether a point is among those of the level: a lattice of every n-th voxel whose points lie nearly evenly
/// on surfaces across any axis (a x + b y + c z divisible by n).
bool belongsTo(std::size_t level, const CloudBrick::Point& p, float per_metre) {
  if (level == 0) return true;
  constexpr std::array<std::array<unsigned, 3>, 4> kLattice{{{0, 0, 0}, {1, 2, 3}, {1, 4, 7}, {1, 8, 27}}};
  // Right for points at voxel centres and at their corners.
  const auto voxel = [per_metre](float metres) {
    return static_cast<unsigned>(std::lround(std::floor(metres * per_metre + 0.25F)));
  };
  const auto& [a, b, c] = kLattice[level];
  return (a * voxel(p.x) + b * voxel(p.y) + c * voxel(p.z)) % kLevelStride[level] == 0;
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
  mine.points = brick.points;
  mine.normals = cellNormals(brick, voxel_size_m);
  for (const CloudBrick::Point& p : brick.points) bounds_.extend(Eigen::Vector3f(p.x, p.y, p.z));
  point_count_ = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(point_count_) + growth);
  dirty_ = true;
  return growth;
}

void CloudChunk::markIfUses(const std::vector<bool>& changed_labels) {
  if (dirty_) return;
  for (const auto& [key, brick] : bricks_) {
    for (const CloudBrick::Point& p : brick.points) {
      if (p.label < changed_labels.size() && changed_labels[p.label]) {
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

void CloudChunk::rebuild(const RegionOfLabel* region_of_label, float voxel_size_m) {
  const auto positions = vtkSmartPointer<vtkFloatArray>::New();
  positions->SetNumberOfComponents(3);
  positions->Allocate(static_cast<vtkIdType>(3 * pointCount(wanted_level_)));
  const auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors->SetNumberOfComponents(3);
  colors->Allocate(static_cast<vtkIdType>(3 * pointCount(wanted_level_)));

  const float brick_m = 8 * voxel_size_m;
  for (const auto& [key, brick] : bricks_) {
    const CellLight light = lightOf(key);
    const Eigen::Vector3f corner = Eigen::Vector3i(key.x, key.y, key.z).cast<float>();
    for (const CloudBrick::Point& p : brick.points) {
      if (!belongsTo(wanted_level_, p, 1 / voxel_size_m)) continue;
      positions->InsertNextTuple3(static_cast<double>(p.x), static_cast<double>(p.y),
                                  static_cast<double>(p.z));
      const bool known = region_of_label != nullptr && p.label < region_of_label->size();
      const Rgb rgb = regionColor(RegionId{known ? (*region_of_label)[p.label] : p.label});
      const float shade = lightAt(light, Eigen::Vector3f(p.x, p.y, p.z) / brick_m - corner);
      colors->InsertNextTuple3(static_cast<double>(shade * rgb[0]), static_cast<double>(shade * rgb[1]),
                               static_cast<double>(shade * rgb[2]));
    }
  }

  // One cell that lists all points.
  const vtkIdType count = positions->GetNumberOfTuples();
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
  const float widening = std::sqrt(static_cast<float>(kLevelStride[level]));
  vtkUniforms* uniforms = actor_->GetShaderProperty()->GetVertexCustomUniforms();
  uniforms->SetUniformf("point_scale", 1.5F * pixels_at_1m * widening);
  uniforms->SetUniformf("point_minimum", level == 0 ? 1.6F : 2.0F);
}

void CloudChunk::collectNormals(std::vector<Eigen::Vector3f>& normals) const {
  for (const auto& [key, brick] : bricks_) {
    const Eigen::Vector3f normal = mainNormal(brick.normals);
    if (normal.squaredNorm() > 0) normals.push_back(normal);
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
