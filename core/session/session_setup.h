#pragma once
#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "core/capture/intrinsics.h"
#include "core/session/saved_scan.h"
#include "core/session/scan_params.h"

namespace scantrove {

/// The setup of a session's scan.
struct SessionSetup {
  std::string source;
  Intrinsics K;  ///< of the recording's depth images
  ScanParams params;
  std::string database;  ///< relative to the session's folder if inside it
  /// Positions and poses of the session are relative to this point of the recording's world: whole metres.
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  std::string poses = {};  ///< "auto", "tracked" or "given"; empty: of an older version
};

/// The stored name of the catalogue for a session in `folder`: a server's address; or a file, relative to the
/// folder if inside it, or if both are of one project (PROJECT/scans/NAME and PROJECT/FILE), which may be
/// moved; else absolute.
[[nodiscard]] std::string storedDatabaseName(const std::string& database,
                                             const std::filesystem::path& folder);
/// The catalogue's file, or its server's address, from the name stored in the session in `folder`.
[[nodiscard]] std::filesystem::path databaseFileOf(const SessionSetup& setup,
                                                   const std::filesystem::path& folder);

/// False: it is a file that is not there. Only opening it shows whether a server has it.
[[nodiscard]] bool mayCatalogueExist(const std::filesystem::path& catalogue);

/// The metadata key for SessionSetup::origin_m.
inline constexpr const char* kOriginKey = "origin_m";
[[nodiscard]] std::string originToText(const Eigen::Vector3d& origin_m);
/// The metadata key for SessionSetup::poses.
inline constexpr const char* kPosesKey = "poses";
/// The metadata key that is set once a scan has read its source to the end. Empty or missing: it was stopped.
inline constexpr const char* kReadToEndKey = "read to end";
/// The metadata key that tells whether the files beside the session (cloud, label map and images) show its
/// current regions. Missing: no such files, or unknown. It is set before the first file is written.
inline constexpr const char *kResultsKey = "results", *kResultsBegun = "begun", *kResultsCurrent = "current",
                            *kResultsEdited = "edited since";
/// The metadata key that is set before the scan writes its first label image.
inline constexpr const char* kLabelImagesKey = "label images";

/// To and from metadata. Error: not the metadata of a session.
[[nodiscard]] SessionMetadata metadataOf(const SessionSetup& setup);
[[nodiscard]] Result<SessionSetup> setupFrom(const SessionMetadata& metadata);

}  // namespace scantrove
