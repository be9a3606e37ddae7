#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "core/discovery/region_appearance.h"
#include "core/scan/scan_snapshot.h"
#include "ui/scene/cloud_chunk.h"
#include "ui/scene/cloud_style.h"

class vtkRenderer;
class vtkCamera;
class vtkProp;

namespace scantrove {

/// The label cloud as points in a VTK renderer, grouped into chunks of bricks. Sends only changed chunks to
/// the graphics card, and draws each chunk at the coarsest level without visible gaps. One thread (that of
/// the OpenGL context).
class CloudChunks {
 public:
  explicit CloudChunks(vtkRenderer* renderer);
  ~CloudChunks();
  CloudChunks(const CloudChunks&) = delete;
  CloudChunks& operator=(const CloudChunks&) = delete;

  void clear();

  /// Voxel size in metres, which is the distance of neighbouring points.
  void setVoxelSize(float meters) { voxel_size_m_ = meters; }

  /// Applies changed bricks (ignores older versions than stored) and changed regions of fragments, and marks
  /// chunks for a rebuild. Cheap; draws nothing.
  void update(std::span<const CloudBrick> changed, const std::vector<RegionChange>& changed_regions);

  void setColoring(Coloring coloring);
  /// Sets the background regions and their style.
  void setBackground(const std::set<RegionId>& regions, BackgroundStyle style);
  /// Sets the selected regions. Unless they are large, they are drawn with blocks of at most 3 voxels.
  void setSelected(const std::set<RegionId>& regions);
  /// Colour that dimmed regions are blended with.
  void setBackdrop(const Rgb& color);
  /// Sets up (unit), and the range of heights along it for colours by height.
  void setHeights(const Eigen::Vector3f& up, float low_m, float high_m);
  void setOverlap(SplatOverlap overlap) { overlap_ = overlap; }
  [[nodiscard]] const CloudStyle& style() const { return style_; }

  /// Chooses levels of detail so that about `point_budget` points are drawn from `camera` in a viewport of
  /// this size. Rebuilds about `rebuild_budget` points of changed chunks; chunks that the user changed come
  /// first, with twice that budget. Returns true when all chunks in view are up to date.
  bool prepare(vtkCamera* camera, int width_px, int height_px, std::size_t point_budget,
               std::size_t rebuild_budget);

  /// Divides the drawn actors into parts of about `points` points. Result: the part of each actor.
  [[nodiscard]] std::map<vtkProp*, std::size_t> divide(std::size_t points) const;

  /// Draws the visible points into `ids`, after its begin().
  void addTo(CloudIds& ids, IdDetail detail) const;
  /// None if there is no such fragment.
  [[nodiscard]] RegionId regionOf(FragmentId fragment) const;

  /// The points of each region with at least `least` points.
  [[nodiscard]] std::map<RegionId, std::vector<AppearancePoint>> pointsOfRegions(std::size_t least) const;

  [[nodiscard]] std::size_t pointCount() const { return point_count_; }
  [[nodiscard]] std::size_t drawnPointCount() const { return drawn_point_count_; }
  [[nodiscard]] std::size_t chunkCount() const { return chunks_.size(); }
  [[nodiscard]] bool upToDate() const;
  [[nodiscard]] const Eigen::AlignedBox3f& bounds() const { return bounds_; }

  /// The first visible point along the ray, within a point's drawn size or a pixel of it. None if there is
  /// none.
  [[nodiscard]] std::optional<Eigen::Vector3f> pick(const Eigen::Vector3f& origin,
                                                    const Eigen::Vector3f& direction,
                                                    float radians_per_pixel) const;
  /// Bounds of these regions; empty if they have no points.
  [[nodiscard]] Eigen::AlignedBox3f boundsOf(const std::set<RegionId>& regions) const;

  /// Surface normals of the bricks (arbitrary sign), weighted by their number of points, for finding "up".
  [[nodiscard]] std::vector<Eigen::Vector3f> brickNormals() const;

  /// Height along `up` (unit) that 2 % of the bricks are below; 0 without bricks.
  [[nodiscard]] float floorHeight(const Eigen::Vector3f& up) const { return heightAbove(up, 0.02F); }
  /// Height along `up` (unit) that this fraction of the bricks is below; 0 without bricks.
  [[nodiscard]] float heightAbove(const Eigen::Vector3f& up, float part) const;

 private:
  struct ChunkKey {
    int x, y, z;
    auto operator<=>(const ChunkKey&) const = default;
  };
  void recolor(const std::vector<RegionChange>& changes);
  void recolorAll();
  /// Marks chunks with regions for which `changed(region)` is true.
  template <class Changed>
  void recolorRegions(const Changed& changed);
  void chooseLevels(vtkCamera* camera, int width_px, int height_px, std::size_t point_budget);

  vtkRenderer* renderer_;
  std::map<ChunkKey, std::unique_ptr<CloudChunk>> chunks_;
  std::vector<RegionId> region_of_fragment_;
  CloudStyle style_;
  std::set<RegionId> selected_;
  SplatOverlap overlap_ = SplatOverlap::exact;
  Eigen::AlignedBox3f bounds_;
  std::size_t point_count_ = 0;
  std::size_t drawn_point_count_ = 0;
  float voxel_size_m_ = 3.0F / 512.0F;
};

}  // namespace scantrove
