#pragma once
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/capture/camera_intrinsics.h"
#include "core/capture/color_camera.h"
#include "core/capture/lens_distortion.h"

namespace scantrove {

/// Cameras of a container, as it describes them.
struct ContainerCameras {
  CameraModel depth;  ///< with its lens and depth scale; K all zeros: not in the file. `color` is not used
  /// The separate colour camera, without distortion; none: colour is registered to depth.
  std::optional<ColorCamera> color;
  std::optional<LensDistortion> color_lens;  ///< of the colour images
  bool is_color_place_known = true;          ///< false: nothing says where the colour camera is
};

/// A depth image and the colour image nearest in time.
struct ContainerFrame {
  double timestamp_s = 0;
  cv::Mat depth;  ///< CV_16UC1, 0 = no reading
  cv::Mat color;  ///< CV_8UC3, BGR; empty: none near in time
};

/// Depth images of an open container, each with its colour image. One thread.
class ContainerImages {
 public:
  virtual ~ContainerImages() = default;

  [[nodiscard]] virtual std::string kind() const = 0;  ///< SourceInfo::kind
  [[nodiscard]] virtual std::size_t count() const = 0;
  [[nodiscard]] virtual bool hasColor() const = 0;
  /// For the sizes of these images.
  [[nodiscard]] virtual Result<ContainerCameras> cameras(const cv::Size& depth, const cv::Size& color) = 0;
  /// Error: names the file; an image is damaged.
  [[nodiscard]] virtual Result<ContainerFrame> read(std::size_t position) = 0;
};

}  // namespace scantrove
