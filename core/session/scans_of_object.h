#pragma once
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// A saved scan in which an object of the catalogue is.
struct ScanOfObject {
  std::filesystem::path folder;
  std::string source;   ///< as given to the scan
  std::string started;  ///< ISO 8601, UTC; empty: unknown
  int key_frames = 0;   ///< of the scan
  int regions = 0;      ///< that are the object
};

/// The sessions in the subfolders of `folder` that have a region of one of these objects, newest first.
/// `catalogue`: the objects' catalogue (ObjectDatabase::identity()); sessions of others are left out, because
/// ids mean nothing there. Reads tables only, as listSessions(), and leaves out what it cannot read. Any
/// thread.
[[nodiscard]] std::vector<ScanOfObject> scansOfObject(const std::filesystem::path& folder,
                                                      const std::string& catalogue,
                                                      const std::set<ObjectId>& objects);

}  // namespace scantrove
