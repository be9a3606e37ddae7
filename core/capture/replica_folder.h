#pragma once
#include <filesystem>
#include <memory>

#include "core/capture/frame_source.h"

namespace scantrove {

/// Whether a folder has NICE-SLAM's `results/depthNNNNNN.*` and `traj.txt`.
[[nodiscard]] bool isReplicaFolder(const std::filesystem::path& folder);

/// A Replica scene as NICE-SLAM rendered it: `results/frameNNNNNN.jpg` registered to
/// `results/depthNNNNNN.png`, 6553.5 units per metre, `traj.txt` with 16 numbers (camera-to-world, row by
/// row) a frame. Camera and unit come from `cam_params.json` in the folder or its parent; without it the
/// camera is that of a file (see findIntrinsics), else Replica's for 1200x680 images. Error: names the file;
/// images of another size without a camera.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openReplicaFolder(const std::filesystem::path& folder,
                                                                     const SourceOptions& options);

}  // namespace scantrove
