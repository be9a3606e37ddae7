#pragma once
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <opencv2/features2d.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/capture/intrinsics.h"
#include "core/capture/rgbd_frame.h"
#include "core/fusion/surface_maps.h"

namespace scantrove {

/// A frame's colour image in grey, at most 640 pixels wide, with its camera.
struct GrayView {
  cv::Mat image;  ///< CV_8UC1; empty: the frame has no colour
  Intrinsics K;
  Eigen::Isometry3d T_color_depth = Eigen::Isometry3d::Identity();
};

/// `K_depth`: of depth images of frames without their own intrinsics.
[[nodiscard]] GrayView grayViewOf(const RgbdFrame& frame, const Intrinsics& K_depth);

/// Makes what is not scanned uniform in a grey image of the frame, so that no corners are found there.
/// `scanned`: RgbdFrame::scanned.
void blankUnscanned(cv::Mat& gray, const cv::Mat& scanned);

/// The map's surface as seen by a colour camera.
class SurfaceInView {
 public:
  /// `vertices_world`: the surface seen by a depth camera, in any order; w = 0: none.
  SurfaceInView(const Intrinsics& K, const Eigen::Isometry3d& T_world_color,
                std::span<const cl_float4> vertices_world);
  /// World point; none where there is no surface, and at outlines, where the surface is ambiguous.
  [[nodiscard]] std::optional<Eigen::Vector3f> at(const cv::Point2f& pixel) const;

 private:
  [[nodiscard]] float depthAt(const cv::Point2f& pixel) const;

  Intrinsics K_;
  Eigen::Isometry3f T_world_color_;
  cv::Mat depths_;  // CV_32FC1 by cell, 0 = none
};

/// Features of a frame's colour image (ORB; Rublee et al. 2011).
struct ColorView {
  Intrinsics K;  ///< of the image with the features
  Eigen::Isometry3d T_color_depth = Eigen::Isometry3d::Identity();
  std::vector<cv::Point2f> pixels;
  cv::Mat descriptors;  ///< n x 32, CV_8UC1
};

/// Features of a view with known points on the map's surface.
struct Landmarks {
  std::vector<cv::Point3f> points_world;
  cv::Mat descriptors;  ///< n x 32, CV_8UC1
};

/// Finds features in colour images. One thread.
class FeatureFinder {
 public:
  /// Without features if there is no colour image or no contrast.
  [[nodiscard]] ColorView find(const GrayView& gray);

 private:
  cv::Ptr<cv::ORB> orb_;
};

/// The features of `view` that are on the map's surface. `vertices_world`: the surface seen by a depth camera
/// at `T_world_depth`; w = 0: none.
[[nodiscard]] Landmarks landmarksOf(const ColorView& view, const Eigen::Isometry3d& T_world_depth,
                                    std::span<const cl_float4> vertices_world);

}  // namespace scantrove
