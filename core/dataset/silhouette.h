#pragma once
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// Where a mesh is seen from a camera whose image had no borders and in which it stood alone.
struct Silhouette {
  cv::Rect box;     ///< pixels of the image, may lie outside; empty: it is not before the camera
  cv::Mat depth_m;  ///< CV_32FC1 of the box, 0 = not of the mesh
  int pixels = 0;   ///< of the mesh, also those outside of the image
  [[nodiscard]] bool empty() const { return pixels == 0; }
  /// The smallest box around its pixels, also those outside of the image.
  [[nodiscard]] cv::Rect tightBox() const;
  /// CV_8UC1 of the camera's image, 255 = of the mesh.
  [[nodiscard]] cv::Mat mask(cv::Size image) const;
};

/// Nothing is looked at beyond one image's width and height on each side, as the tools for BOP do.
[[nodiscard]] Silhouette silhouetteOf(const LabeledMesh& mesh, const Intrinsics& K,
                                      const Eigen::Isometry3d& T_world_camera);

/// The smallest box around what is not 0 in `mask` (CV_8UC1); empty if nothing is.
[[nodiscard]] cv::Rect boxOf(const cv::Mat& mask);

}  // namespace scantrove
