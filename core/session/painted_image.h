#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/fusion/rendered_view.h"
#include "core/session/open_session.h"

namespace scantrove {

/// The regions of a key frame's image with what a person painted there. Outlines are those of the map.
class PaintedImage {
 public:
  /// None: nobody painted in that image. Error: the device failed.
  [[nodiscard]] static Result<std::optional<PaintedImage>> of(OpenSession& session,
                                                              const SavedKeyFrame& key_frame);

  /// The region where the image shows the point; `otherwise` where it shows another surface, or none.
  [[nodiscard]] RegionId regionAt(const Eigen::Vector3f& point_world, RegionId otherwise) const;
  /// Sets the regions of a view of the same frame.
  void applyTo(RenderedView& view) const;

 private:
  Intrinsics K_;
  Eigen::Isometry3f T_camera_world_;
  cv::Mat regions_, depth_m_;  // ViewOfMap
};

}  // namespace scantrove
