#pragma once
#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "core/capture/intrinsics.h"
#include "core/exchange/region_palette.h"
#include "core/tracking/pose_estimate.h"

class vtkRenderer;

namespace scantrove {

/// Sensor and trajectory: a small pyramid for the field of view, coloured by the tracking state, and its
/// path.
class SensorTrack {
 public:
  using Trail = std::shared_ptr<const std::vector<Eigen::Vector3f>>;

  explicit SensorTrack(vtkRenderer* renderer);

  void clear();
  void setPose(const PoseEstimate& pose, const Intrinsics& K);
  void setTrail(const Trail& trail);
  void setTrailColor(const Rgb& color);
  [[nodiscard]] const Eigen::AlignedBox3f& bounds() const { return bounds_; }

 private:
  struct Part {
    vtkSmartPointer<vtkPolyData> data;
    vtkSmartPointer<vtkActor> actor;
  };
  static Part addPart(vtkRenderer* renderer, float line_width);

  Part edges_;
  Part faces_;
  Part path_;
  Trail trail_;
  Eigen::AlignedBox3f bounds_;
};

}  // namespace scantrove
