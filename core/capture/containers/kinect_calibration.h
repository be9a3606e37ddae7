#pragma once
#include <string>

#include "core/base/result.h"
#include "core/capture/containers/container_images.h"

namespace scantrove {

/// Cameras of an Azure Kinect or Orbbec Femto from its calibration.json, for its modes of these image sizes.
/// The depth scale is 1000. Error: names `name`; damaged, or sizes of no mode.
[[nodiscard]] Result<ContainerCameras> kinectCameras(const std::string& json, const cv::Size& depth,
                                                     const cv::Size& color, const std::string& name);

}  // namespace scantrove
