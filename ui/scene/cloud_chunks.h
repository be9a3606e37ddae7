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

/// The label cloud as points in a VTK renderer, grouped into chunks of bricks. Only chunks whose bricks
/// changed are sent to the graphics card again, and each chunk is drawn at the coarsest level that still
/// looks closed from where the camera stands. One thread (the one of the OpenGL context).
class CloudChunks {
 public:
  explicit CloudChunks(vtkRenderer* renderer);
  ~CloudChunks();
  CloudChunks(const CloudChunks&) = delete;
  CloudChunks& operator=(const CloudChunks&) = delete;

  void clear();

  /// Edge of a voxel in metres: the distance of neighbouring points, for closing gaps between them.
  void setVoxelSize(float meters) { voxel_size_m_ = meters; }

  /// Takes over the changed bricks (older versions than the stored are ignored) and the fragments that are of
  /// other regions now; marks what must be rebuilt or recoloured. Cheap; nothing is drawn.
  void update(std::span<const CloudBrick> changed, const std::vector<RegionChange>& changed_regions);

  void setColoring(Coloring coloring);
  /// These regions are background, and look like that from now on.
  void setBackground(const std::set<RegionId>& regions, BackgroundStyle style);
  /// These regions are selected: as long as they are small, what is drawn of them is never coarser than
  /// blocks of 3 voxels.
  void setSelected(const std::set<RegionId>& regions);
  /// What dimmed regions nearly become.
  void setBackdrop(const Rgb& color);
  /// Up (unit), and between which heights along it the scene's colours by height run.
  void setHeights(const Eigen::Vector3f& up, float low_m, float high_m);
  void setOverlap(SplatOverlap overlap) { overlap_ = overlap; }
  [[nodiscard]] const CloudStyle& style() const { return style_; }

  /// Chooses each chunk's level of detail so that about `point_budget` points are drawn from `camera` in a
  /// viewport of `height_px`, and rebuilds about `rebuild_budget` points of chunks that changed: first, and a
  /// few times as many, of those that a person changed. Returns true when all chunks in view are up to date.
  bool prepare(vtkCamera* camera, int width_px, int height_px, std::size_t point_budget,
               std::size_t rebuild_budget);

  /// Divides what is drawn into parts of about so many points; which part each actor is of.
  [[nodiscard]] std::map<vtkProp*, std::size_t> divide(std::size_t points) const;

  /// What is shown, into `ids`, which has begun.
  void addTo(CloudIds& ids, IdDetail detail) const;
  /// None: no such fragment.
  [[nodiscard]] RegionId regionOf(FragmentId fragment) const;

  /// The points of each region that has at least so many.
  [[nodiscard]] std::map<RegionId, std::vector<AppearancePoint>> pointsOfRegions(std::size_t least) const;

  [[nodiscard]] std::size_t pointCount() const { return point_count_; }
  [[nodiscard]] std::size_t drawnPointCount() const { return drawn_point_count_; }
  [[nodiscard]] std::size_t chunkCount() const { return chunks_.size(); }
  [[nodiscard]] bool upToDate() const;
  [[nodiscard]] const Eigen::AlignedBox3f& bounds() const { return bounds_; }

  /// The point of the cloud that a look from `origin` along `direction` meets first: within a point's drawn
  /// size of the ray, or within a pixel. None where it meets nothing; what is hidden is not there.
  [[nodiscard]] std::optional<Eigen::Vector3f> pick(const Eigen::Vector3f& origin,
                                                    const Eigen::Vector3f& direction,
                                                    float radians_per_pixel) const;
  /// Empty when there are no points of these regions.
  [[nodiscard]] Eigen::AlignedBox3f boundsOf(const std::set<RegionId>& regions) const;

  /// Surface normals of the bricks (sign arbitrary), weighted by their number of points: for finding "up".
  [[nodiscard]] std::vector<Eigen::Vector3f> brickNormals() const;

  /// Height along `up` (unit) below which only 2 % of the bricks lie; 0 when there are none.
  [[nodiscard]] float floorHeight(const Eigen::Vector3f& up) const { return heightAbove(up, 0.02F); }
  /// Height along `up` (unit) below which that part of the bricks lies; 0 when there are none.
  [[nodiscard]] float heightAbove(const Eigen::Vector3f& up, float part) const;

 private:
  struct ChunkKey {
    int x, y, z;
    auto operator<=>(const ChunkKey&) const = default;
  };
  void recolor(const std::vector<RegionChange>& changes);
  void recolorAll();
  /// What is drawn of regions for which `changed(region)`.
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
