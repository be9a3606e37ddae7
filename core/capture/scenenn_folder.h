#pragma once
#include <filesystem>
#include <memory>

#include "core/capture/frame_source.h"

namespace scantrove {

/// Whether a folder has SceneNN's `image/imageNNNNN.*` and `depth/depthNNNNN.*`.
[[nodiscard]] bool isSceneNnFolder(const std::filesystem::path& folder);

/// A scene extracted from SceneNN's .oni: colour registered to depth, depth in mm, poses in `trajectory.log`
/// (camera-to-world). The camera is that of a file (see findIntrinsics), else the data set's Xtion for
/// 640x480 images. Error: names the file; images of another size without a camera.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openSceneNnFolder(const std::filesystem::path& folder,
                                                                     const SourceOptions& options);

}  // namespace scantrove
