#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// What an app on a phone or tablet recorded: 3D Scanner App, Stray Scanner, Record3D, Polycam, MultiScan,
/// the iPhone recordings of ScanNet++, ARKitScenes, a transforms.json with depth, single LiDAR shots. Told by
/// the content.

/// Whether the folder, with `names` in it (sorted), is one of these.
[[nodiscard]] bool isPhoneFolder(const std::filesystem::path& folder, const std::vector<std::string>& names);

/// Opens it. Its poses are the device's own. Error: names the file and what to export instead.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openPhoneFolder(const std::filesystem::path& folder,
                                                                   const std::vector<std::string>& names,
                                                                   const SourceOptions& options);

/// Opens a recording of Record3D (.r3d) in the same way.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openRecord3dFile(const std::filesystem::path& file,
                                                                    const SourceOptions& options);

}  // namespace scantrove
