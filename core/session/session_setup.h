#pragma once
#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "core/capture/intrinsics.h"
#include "core/session/saved_scan.h"
#include "core/session/scan_params.h"

namespace scantrove {

/// What a session was scanned with.
struct SessionSetup {
  std::string source;
  Intrinsics K;  ///< of the recording's depth images
  ScanParams params;
  std::string database;  ///< relative to the session's folder where it lies in it
  /// Places and poses of the session are relative to this point of the recording's world: whole metres.
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
};

/// How a session in `folder` keeps the name of its catalogue: relative to the folder where it lies in it,
/// else absolute.
[[nodiscard]] std::string storedDatabaseName(const std::string& database,
                                             const std::filesystem::path& folder);
/// The catalogue's file, from what a session in `folder` keeps.
[[nodiscard]] std::filesystem::path databaseFileOf(const SessionSetup& setup,
                                                   const std::filesystem::path& folder);

/// The fact that tells SessionSetup::origin_m.
inline constexpr const char* kOriginKey = "origin_m";
[[nodiscard]] std::string originToText(const Eigen::Vector3d& origin_m);
/// The fact that says whether the files beside the session (cloud, label map and images) show its regions as
/// they are now; without it there are none, or it is not known. It is set before the first file is written.
inline constexpr const char *kResultsKey = "results", *kResultsBegun = "begun", *kResultsCurrent = "current",
                            *kResultsEdited = "edited since";
/// Set before the scan writes its first label image.
inline constexpr const char* kLabelImagesKey = "label images";

/// As facts, and back. Error: they are not those of a session.
[[nodiscard]] SessionMetadata metadataOf(const SessionSetup& setup);
[[nodiscard]] Result<SessionSetup> setupFrom(const SessionMetadata& metadata);

}  // namespace scantrove
