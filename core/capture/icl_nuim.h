#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/capture/frame_source.h"
#include "core/capture/pose_files.h"

namespace scantrove {

/// Whether a folder has `rgb/`, `depth/`, and ICL-NUIM's `*.gt.freiburg`, or its `associations.txt` with
/// frame numbers (`0 depth/0.png 0 rgb/0.png`) and no `depth.txt`. `names`: the folder's files.
[[nodiscard]] bool isIclNuimFolder(const std::filesystem::path& folder,
                                   const std::vector<std::string>& names);

/// An ICL-NUIM scene, TUM-compatible: `rgb/N.png`, `depth/N.png`, 5000 units per metre, poses in
/// `*.gt.freiburg` or `groundtruth.txt` by frame number. The data set's camera has fy = -480: its y axis
/// points up and its frames are left-handed. Scantrove reads fy = 480 and mirrors the poses. A camera file
/// (see findIntrinsics) replaces the data set's; poses are mirrored if its fy is negative. Error: names the
/// file.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openIclNuimFolder(const std::filesystem::path& folder,
                                                                     const std::vector<std::string>& names,
                                                                     const SourceOptions& options);

/// Reads `N tx ty tz qx qy qz qw` lines. `is_mirrored`: poses become those of a camera with y down, in a
/// world that is mirrored alike. Error: as readTumTrajectory().
[[nodiscard]] Result<std::vector<NumberedPose>> readIclNuimPoses(const std::filesystem::path& file,
                                                                 bool is_mirrored);

/// The `*.gt.freiburg` among the names of a folder's files; empty: there is none.
[[nodiscard]] std::optional<std::string> iclNuimPoseFile(const std::vector<std::string>& names);

}  // namespace scantrove
