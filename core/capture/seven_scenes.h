#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/capture/frame_source.h"

namespace scantrove {

/// Whether the names of a folder's files include `frame-NNNNNN.depth.png` or `.depth.pgm`.
[[nodiscard]] bool isSevenScenesFolder(const std::vector<std::string>& names);

/// A folder of `frame-NNNNNN.{color.jpg|png, depth.png|pgm, pose.txt}` (Shotton 2013): depth in mm, 0 and
/// 65535 invalid, pose camera-to-world. The cameras are those of BundleFusion's `info.txt` or 3RScan's
/// `_info.txt` (see rig_info.h), else `camera-intrinsics.txt`, else 585 585 320 240. These default values
/// identify the data set's Kinect, whose colour was not registered (see SourceOptions::color_registration).
/// Index = the number in the name, timestamp = index / 30.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openSevenScenes(const std::filesystem::path& folder,
                                                                   const std::vector<std::string>& names,
                                                                   const SourceOptions& options);

}  // namespace scantrove
