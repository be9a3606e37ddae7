#pragma once
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <cstddef>

#include "core/scan/scan_snapshot.h"
#include "ui/scene/cloud_chunks.h"
#include "ui/scene/ground_grid.h"
#include "ui/scene/orbit_camera.h"
#include "ui/scene/sensor_track.h"

namespace scantrove {

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
  void setVoxelSize(float metres) { cloud_.setVoxelSize(metres); }
  void setColors(const Colors& colors);
  void setGridVisible(bool visible) { grid_.setVisible(visible); }

  /// Takes over what is new in the snapshot; draws nothing.
  void update(const ScanSnapshot& snapshot);

  /// The viewpoint trails the sensor and looks where it looks; any call of viewpoint() by the person's hand
  /// should end it.
  void setFollowing(bool following);
  [[nodiscard]] bool following() const { return following_; }
  [[nodiscard]] OrbitCamera& viewpoint() { return viewpoint_; }
  void fitAll(float aspect);

  /// To call right before rendering into a viewport of this size; see CloudChunks::prepare.
  bool prepare(int width_px, int height_px, std::size_t point_budget, std::size_t rebuild_budget);

  /// What the last drawing shows, at `scale` of its size.
  void drawIds(int width_px, int height_px, float scale, CloudIds& ids) const {
    ids.begin(renderer_->GetActiveCamera(), width_px, height_px, scale);
    cloud_.addTo(ids);
  }

  [[nodiscard]] const CloudChunks& cloud() const { return cloud_; }

 private:
  void levelOut();

  vtkSmartPointer<vtkRenderer> renderer_;
  CloudChunks cloud_;
  SensorTrack sensor_;
  GroundGrid grid_;
  OrbitCamera viewpoint_;
  bool following_ = true;
  bool has_pose_ = false;
  Eigen::Matrix3f R_world_camera_ = Eigen::Matrix3f::Identity();  ///< of the first frame
  Eigen::Vector3f up_ = -Eigen::Vector3f::UnitY();  ///< of the scene; the viewpoint's only when it may turn
  std::size_t points_at_leveling_ = 0;
};

}  // namespace scantrove
