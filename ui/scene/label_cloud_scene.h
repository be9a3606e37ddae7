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

/// Standard views, relative to the sensor's view in the first frame.
enum class StandardView { front, back, left, right, top, bottom };

/// Content of the 3D view in one renderer: cloud, sensor, grid and viewpoint. Does not use Qt. The owner of
/// an OpenGL context adds renderer() to a render window. One thread.
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

  /// Applies a snapshot; draws nothing.
  void update(const ScanSnapshot& snapshot) {
    updateAllButBricks(snapshot);
    updateBricks(snapshot.changed_bricks);
  }
  /// The two steps of update(); bricks may be split over several calls.
  void updateAllButBricks(const ScanSnapshot& snapshot);
  void updateBricks(std::span<const CloudBrick> changed);

  /// Makes the viewpoint follow the sensor. Call with false before the user changes viewpoint().
  void setFollowing(bool following);
  [[nodiscard]] bool following() const { return following_; }
  [[nodiscard]] OrbitCamera& viewpoint() { return viewpoint_; }
  void fitAll(float aspect);

  /// Shows all of `box` from the current direction.
  void fit(const Eigen::AlignedBox3f& box, float aspect);
  /// Turns to a standard view; `front` is the sensor's first view direction. The target stays.
  void lookFrom(StandardView from);

  void setOverlap(SplatOverlap overlap) { cloud_.setOverlap(overlap); }
  void setColoring(Coloring coloring) { cloud_.setColoring(coloring); }
  /// See CloudChunks.
  void setSelected(const std::set<RegionId>& regions) { cloud_.setSelected(regions); }
  void setBackground(const std::set<RegionId>& regions, BackgroundStyle style) {
    cloud_.setBackground(regions, style);
  }

  /// Hides everything in front of a plane `behind_target_m` behind the viewpoint's target (before it, if
  /// negative). None: no clip plane.
  void setClipDistance(std::optional<float> behind_target_m) { clip_behind_target_m_ = behind_target_m; }
  /// Distance of the clip plane from the eye; none: no clip plane.
  [[nodiscard]] std::optional<float> clipDistance() const;

  /// The visible surface point at a position of the picture, x to the right and y up, each -1..1 from edge to
  /// edge. None if there is none.
  [[nodiscard]] std::optional<Eigen::Vector3f> pick(float x, float y, int width_px, int height_px) const;
  /// Shows a measured line through these points; empty: no line.
  void showMeasure(const std::vector<Eigen::Vector3f>& points) { measure_.show(points); }

  /// Shows an arrow around `center`; see MoveArrow::show.
  void showArrow(const Eigen::Vector3f& center, const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
    arrow_.show(center, up_, from, to);
  }
  void hideArrow() { arrow_.hide(); }
  /// Up, and the direction towards the sensor in the first frame.
  [[nodiscard]] SideAxes sideAxes() const { return SideAxes::of(up_, -R_world_camera_.col(2)); }

  /// Call right before rendering into a viewport of this size; see CloudChunks::prepare.
  bool prepare(int width_px, int height_px, std::size_t point_budget, std::size_t rebuild_budget);

  /// After prepare(): splits the drawing into parts of about `points` points. Call nextPart() after each
  /// drawing; it is true while parts remain.
  void beginParts(std::size_t points);
  bool nextPart() { return parts_.next(); }

  /// Draws the ids of the last drawing at `scale` of its size.
  void drawIds(int width_px, int height_px, float scale, CloudIds& ids) const {
    ids.begin(renderer_->GetActiveCamera(), width_px, height_px, scale);
    cloud_.addTo(ids, IdDetail::drawn);
  }
  /// Draws the ids of a part, in pixels at `scale`, from all points, whatever the drawn level of detail.
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
  Eigen::Vector3f up_ =
      -Eigen::Vector3f::UnitY();  ///< of the scene; the viewpoint may still have an older one
  std::size_t points_at_leveling_ = 0;
  std::optional<float> clip_behind_target_m_;
};

}  // namespace scantrove
