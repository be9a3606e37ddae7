#pragma once
#include <memory>

#include "core/capture/containers/container_images.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// Makes a source of a container's images: selects the frames and decodes the first usable one, whose image
/// sizes decide the cameras. Both images are undistorted. A frame with a damaged image, or one of another
/// size, is skipped. Error: names `path`; bad options, no usable frame, unknown intrinsics.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openContainerSource(
    std::unique_ptr<ContainerImages> images, const std::filesystem::path& path, const SourceOptions& options);

}  // namespace scantrove
