#pragma once
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "core/geometry/view_coverage.h"
#include "core/scan/scan_snapshot.h"
#include "ui/scene/cloud_chunks.h"
#include "ui/scene/drawing_parts.h"
#include "ui/scene/ground_grid.h"
#include "ui/scene/measure_line.h"
#include "ui/scene/move_arrow.h"
#include "ui/scene/orbit_camera.h"
#include "ui/scene/sensor_track.h"

namespace scantrove {

/// From where the scene is looked at, as it stood before the sensor in its first frame.
enum class StandardView { front, back, left, right, top, bottom };

/// All that the 3D view shows, behind one renderer: cloud, sensor, grid, and the viewpoint. Free of Qt;
/// whoever owns an OpenGL context adds renderer() to a render window. One thread.
class LabelCloudScene {
 public:
  struct Colors {
    Rgb background_top{38, 42, 50};
    Rgb background_bottom{24, 26, 31};
    Rgb grid{62, 67, 77};
    Rgb trail{225, 229, 235};
  };

  LabelCloudScene();

  [[nodiscard]] vtkRenderer* renderer() { return renderer_; }
  void clear();
  void setVoxelSize(float meters) { cloud_.setVoxelSize(meters); }
  void setColors(const Colors& colors);
  void setGridVisible(bool visible) { grid_.setVisible(visible); }

  /// Takes over what is new in the snapshot; draws nothing.
  void update(const ScanSnapshot& snapshot) {
    updateAllButBricks(snapshot);
    updateBricks(snapshot.changed_bricks);
  }
  /// The same in two steps; the bricks may come in several.
  void updateAllButBricks(const ScanSnapshot& snapshot);
  void updateBricks(std::span<const CloudBrick> changed);

  /// The viewpoint trails the sensor and looks where it looks; any call of viewpoint() by the person's hand
  /// should end it.
  void setFollowing(bool following);
  [[nodiscard]] bool following() const { return following_; }
  [[nodiscard]] OrbitCamera& viewpoint() { return viewpoint_; }
  void fitAll(float aspect);

  /// Looks at all of `box` from the present direction.
  void fit(const Eigen::AlignedBox3f& box, float aspect);
  /// Turns to a standard view: `front` is how the sensor looked at first. The target stays.
  void lookFrom(StandardView from);

  void setOverlap(SplatOverlap overlap) { cloud_.setOverlap(overlap); }
  void setColoring(Coloring coloring) { cloud_.setColoring(coloring); }
  /// See CloudChunks.
  void setSelected(const std::set<RegionId>& regions) { cloud_.setSelected(regions); }
  void setBackground(const std::set<RegionId>& regions, BackgroundStyle style) {
    cloud_.setBackground(regions, style);
  }

  /// Leaves out what is nearer to the viewer than a plane through the viewpoint's target, or so far behind
  /// it (before it, if negative); none: shows all.
  void setClipDistance(std::optional<float> behind_target_m) { clip_behind_target_m_ = behind_target_m; }
  /// How far from the eye the plane is; none: there is no cut.
  [[nodiscard]] std::optional<float> clipDistance() const;

  /// The point of the surface that is seen at a place of the picture, x to the right and y up, each -1..1
  /// from edge to edge. None where there is nothing; what is hidden or cut away is not there.
  [[nodiscard]] std::optional<Eigen::Vector3f> pick(float x, float y, int width_px, int height_px) const;
  /// A measured line through these points; none: no line.
  void showMeasure(const std::vector<Eigen::Vector3f>& points) { measure_.show(points); }

  /// An arrow around `centre`; see MoveArrow::show.
  void showArrow(const Eigen::Vector3f& center, const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
    arrow_.show(center, up_, from, to);
  }
  void hideArrow() { arrow_.hide(); }
  /// Up, and the side of things from which the sensor saw them first.
  [[nodiscard]] SideAxes sideAxes() const { return SideAxes::of(up_, -R_world_camera_.col(2)); }

  /// To call right before rendering into a viewport of this size; see CloudChunks::prepare.
  bool prepare(int width_px, int height_px, std::size_t point_budget, std::size_t rebuild_budget);

  /// After prepare(): the drawings that follow are of a part of the scene each, with about so many points,
  /// one over the other. nextPart() after each but the last tells that there is one more.
  void beginParts(std::size_t points);
  bool nextPart() { return parts_.next(); }

  /// What the last drawing shows, at `scale` of its size.
  void drawIds(int width_px, int height_px, float scale, CloudIds& ids) const {
    ids.begin(renderer_->GetActiveCamera(), width_px, height_px, scale);
    cloud_.addTo(ids, IdDetail::drawn);
  }
  /// A part of it, in pixels at `scale` of its size, from all the points that there are, however coarsely
  /// they were drawn.
  void drawIdsFinely(int width_px, int height_px, float scale, const CloudIds::Part& part,
                     CloudIds& ids) const {
    ids.begin(renderer_->GetActiveCamera(), width_px, height_px, scale, part);
    cloud_.addTo(ids, IdDetail::finest);
  }

  [[nodiscard]] const CloudChunks& cloud() const { return cloud_; }

 private:
  void levelOut();

  vtkSmartPointer<vtkRenderer> renderer_;
  CloudChunks cloud_;
  SensorTrack sensor_;
  GroundGrid grid_;
  MeasureLine measure_;
  MoveArrow arrow_;
  DrawingParts parts_;
  OrbitCamera viewpoint_;
  bool following_ = true;
  bool has_pose_ = false;
  Eigen::Matrix3f R_world_camera_ = Eigen::Matrix3f::Identity();  ///< of the first frame
  Eigen::Vector3f up_ = -Eigen::Vector3f::UnitY();  ///< of the scene; the viewpoint's only when it may turn
  std::size_t points_at_leveling_ = 0;
  std::optional<float> clip_behind_target_m_;
};

}  // namespace scantrove
