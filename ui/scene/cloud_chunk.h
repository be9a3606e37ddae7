#pragma once
#include <vtkActor.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "core/discovery/region_appearance.h"
#include "core/scan/scan_snapshot.h"
#include "ui/scene/brick_shading.h"
#include "ui/scene/cloud_ids.h"
#include "ui/scene/cloud_pick.h"
#include "ui/scene/cloud_style.h"
#include "ui/scene/splats.h"

class vtkRenderer;

namespace scantrove {

/// Bricks along the edge of a chunk.
inline constexpr int kChunkBricks = 16;
/// Level n draws about every kLevelStride[n]-th point, with larger discs.
inline constexpr std::array<std::size_t, 5> kLevelStride{1, 2, 4, 16, 64};
/// Number of points of each level.
using LevelCounts = std::array<std::size_t, kLevelStride.size()>;

/// Points used for a picture of fragments: the drawn ones or all.
enum class IdDetail { drawn, finest };

/// A cube of bricks that is one VTK actor, at one of several levels of detail.
class CloudChunk {
 public:
  using RegionOfFragment = std::vector<RegionId>;

  explicit CloudChunk(vtkRenderer* renderer);
  ~CloudChunk();
  CloudChunk(const CloudChunk&) = delete;
  CloudChunk& operator=(const CloudChunk&) = delete;

  /// Replaces the brick's points unless the stored version is newer or has the same appearance. Returns the
  /// change of the number of points.
  std::ptrdiff_t setBrick(const CloudBrick& brick, float voxel_size_m);

  /// Marks the chunk for a rebuild if it holds a fragment with `changed[fragment]`. `urgently`: the user
  /// waits for it.
  void markDirtyIfUses(const std::vector<bool>& changed, bool urgently = false);
  /// Whether the user waits for its rebuild.
  [[nodiscard]] bool urgent() const { return urgent_; }

  /// Whether it has points of a selected region. The result is cached until resetSelected().
  [[nodiscard]] bool hasSelected(const std::set<RegionId>& selected,
                                 const RegionOfFragment& region_of_fragment);
  void resetSelected() { has_selected_.reset(); }

  void setLevel(std::size_t level);
  [[nodiscard]] std::size_t level() const { return target_level_; }
  [[nodiscard]] bool dirty() const { return dirty_ || built_level_ != target_level_; }
  [[nodiscard]] bool shown() const { return built_level_ < kLevelStride.size(); }
  /// Sets whether the chunk is in view; others are neither drawn nor rebuilt.
  void show(bool visible);
  [[nodiscard]] bool inView() const { return in_view_; }

  [[nodiscard]] vtkProp* prop() const { return actor_; }

  /// Marks the chunk for a rebuild.
  void markAll() { dirty_ = true; }

  /// Sends points and colours of the chosen level to VTK.
  void rebuild(const RegionOfFragment& region_of_fragment, const CloudStyle& style, float voxel_size_m);

  /// Sets the view, which with the level determines the size of points.
  void setView(const SplatView& view, SplatOverlap overlap, float voxel_size_m);

  /// Appends the visible points near the ray, in any order.
  void collectNear(const PickRay& ray, const RegionOfFragment& region_of_fragment, const CloudStyle& style,
                   float voxel_size_m, std::vector<PickedPoint>& found) const;
  /// Extends `box` by the points of these regions.
  void extendByRegions(const std::set<RegionId>& regions, const RegionOfFragment& region_of_fragment,
                       float voxel_size_m, Eigen::AlignedBox3f& box) const;

  /// Draws the visible points into `ids`.
  void addTo(CloudIds& ids, const RegionOfFragment& region_of_fragment, const CloudStyle& style,
             float voxel_size_m, IdDetail detail) const;

  [[nodiscard]] std::size_t pointCount() const { return count_[0]; }
  /// Number of points of the level.
  [[nodiscard]] std::size_t pointCount(std::size_t level) const { return count_[level]; }
  [[nodiscard]] const Eigen::AlignedBox3f& bounds() const { return bounds_; }
  void collectNormals(std::vector<Eigen::Vector3f>& normals) const;
  /// Appends the points of each fragment below `of_fragment.size()`.
  void collectPoints(std::vector<std::vector<AppearancePoint>>& of_fragment) const;
  /// Appends one height along `up` for each brick.
  void collectHeights(const Eigen::Vector3f& up, std::vector<float>& heights) const;

  int waiting_rounds = 0;  ///< number of postponed rebuilds

 private:
  struct Brick {
    std::uint64_t version = 0;
    std::vector<CloudBrick::Point> points;  ///< points of coarser levels first
    std::vector<PackedNormal> smooth;       ///< of the points drawn so far
    std::vector<FragmentId> fragments;      ///< of the points, without duplicates
    LevelCounts count{};
    CellNormals normals;
    std::size_t points_when_shaped = 0;  ///< number of points when the normals were computed
    std::optional<CellLight> light;      ///< none: must be computed

    /// The point with its smooth normal, if that was computed.
    [[nodiscard]] CloudBrick::Point shown(std::size_t point) const;
  };
  struct BrickKey {
    int x, y, z;
    auto operator<=>(const BrickKey&) const = default;
  };

  /// Size of the points of a level.
  struct Disc {
    float diameter_m, least_px;
  };
  [[nodiscard]] static Disc discOf(std::size_t level, float voxel_size_m);

  void resetLightAround(const BrickKey& key);
  [[nodiscard]] CellLight lightOf(const BrickKey& key) const;

  vtkRenderer* renderer_;
  vtkSmartPointer<vtkActor> actor_;
  vtkSmartPointer<vtkOpenGLPolyDataMapper> mapper_;
  std::map<BrickKey, Brick> bricks_;
  Eigen::AlignedBox3f bounds_;
  LevelCounts count_{};
  std::size_t target_level_ = 0;
  std::size_t built_level_ = kLevelStride.size();  ///< none yet
  bool dirty_ = true;
  bool urgent_ = false;
  bool in_view_ = false;
  std::optional<bool> has_selected_;  // none: must be computed
  SplatOverlap overlap_ = SplatOverlap::exact;
};

}  // namespace scantrove
