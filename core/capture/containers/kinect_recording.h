#pragma once
#include <memory>

#include "core/capture/containers/container_images.h"
#include "core/capture/containers/matroska_file.h"

namespace scantrove {

/// Images of an Azure Kinect's or Orbbec Femto's recording (k4arecorder): depth of 16 bits, big-endian, in
/// millimetres; colour as JPEG, NV12, YUY2 or BGRA. Error: names the file; it has no such depth track.
[[nodiscard]] Result<std::unique_ptr<ContainerImages>> openKinectRecording(
    std::unique_ptr<MatroskaFile> file);

}  // namespace scantrove
