#pragma once
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// The image of a mesh alone, from a camera without image borders.
struct Silhouette {
  cv::Rect box;     ///< pixels of the image, may lie outside; empty: not in front of the camera
  cv::Mat depth_m;  ///< CV_32FC1 of the box, 0 = not the mesh
  int pixels = 0;   ///< of the mesh, including those outside of the image
  [[nodiscard]] bool empty() const { return pixels == 0; }
  /// The smallest box around its pixels, including those outside of the image.
  [[nodiscard]] cv::Rect tightBox() const;
  /// CV_8UC1 of the camera's image, 255 = mesh.
  [[nodiscard]] cv::Mat mask(cv::Size image) const;
};

/// Ignores everything beyond one image's width and height on each side, as the tools for BOP do.
[[nodiscard]] Silhouette silhouetteOf(const LabeledMesh& mesh, const Intrinsics& K,
                                      const Eigen::Isometry3d& T_world_camera);

/// The smallest box around nonzero pixels of `mask` (CV_8UC1); empty if there are none.
[[nodiscard]] cv::Rect boxOf(const cv::Mat& mask);

}  // namespace scantrove
