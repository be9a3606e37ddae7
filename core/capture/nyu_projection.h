#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/capture/color_camera.h"
#include "core/capture/intrinsics.h"
#include "core/capture/lens_distortion.h"

namespace scantrove {

/// The Kinect of NYUv2 as the data set's toolbox calibrates it (camera_params.m). The toolbox counts pixels
/// from 1; these cameras count from 0.
struct NyuCameras {
  Intrinsics depth, color;
  LensDistortion depth_lens, color_lens;
  Eigen::Isometry3d T_color_depth = Eigen::Isometry3d::Identity();
};

/// The cameras for images of `size`; the data set's are 640 x 480.
[[nodiscard]] NyuCameras nyuCameras(const cv::Size& size);

/// z in metres of a raw Kinect value: 351.3 / (1092.5 - raw). 0 outside 0.35 - 10 m, where the camera does
/// not measure; 2047 is its "no reading".
[[nodiscard]] float nyuDepth(std::uint16_t raw);

/// Units per metre of NyuProjection::depth: 0.2 mm, finer than the Kinect's steps, and 10 m fit in 16 bits.
inline constexpr double kNyuUnitsPerMeter = 5000;

/// Takes raw images of the data set into the undistorted colour camera, where its labels are. Any thread.
class NyuProjection {
 public:
  /// `size` of depth and colour images.
  explicit NyuProjection(const cv::Size& size);

  /// The undistorted colour camera.
  [[nodiscard]] const Intrinsics& intrinsics() const { return cameras_.color; }
  [[nodiscard]] cv::Size size() const { return {cameras_.depth.width, cameras_.depth.height}; }

  /// Depth seen from the colour camera, CV_16UC1 in kNyuUnitsPerMeter, 0 = none. `raw`: CV_16UC1 of size(),
  /// values of the Kinect. Of several surfaces in a pixel the nearest counts.
  [[nodiscard]] cv::Mat depth(const cv::Mat& raw) const;
  /// The colour image without lens distortion. `image`: CV_8UC3 of size().
  [[nodiscard]] cv::Mat color(const cv::Mat& image) const { return color_undistorter_.ofColor(image); }

 private:
  NyuCameras cameras_;
  Undistorter depth_undistorter_, color_undistorter_;
  std::vector<Eigen::Vector3f> rays_;  // of each depth pixel at z = 1, in axes of the colour camera
};

}  // namespace scantrove
