#pragma once
#include <filesystem>
#include <optional>

#include "core/base/result.h"
#include "core/capture/camera_intrinsics.h"

namespace scantrove {

/// Reads the `info.txt` of BundleFusion or `_info.txt` of 3RScan, lines `m_name = values`: sizes, projections
/// and places of both cameras, and `m_depthShift`, the depth units per metre. Error: names the file and the
/// missing line.
[[nodiscard]] Result<CameraModel> readRigInfo(const std::filesystem::path& file);

/// The file of readRigInfo() in `folder`; empty: there is none.
[[nodiscard]] std::optional<std::filesystem::path> findRigInfo(const std::filesystem::path& folder);

}  // namespace scantrove
