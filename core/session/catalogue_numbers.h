#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "core/base/result.h"
#include "core/catalogue/object_database.h"
#include "core/session/saved_scan.h"

namespace scantrove {

/// Which catalogue is asked.
struct CatalogueIdentity {
  std::string uuid = {};     ///< ObjectDatabase::identity()
  bool has_session = false;  ///< a scan began there when the session did: tells sessions of older versions
};

/// The numbers of a catalogue's objects that a session keeps. They mean nothing in another catalogue.
struct CatalogueNumbers {
  SessionMetadata metadata;  ///< of the session; empty value: there is none
  std::map<RegionId, ObjectId> objects;
};

/// The fact that names the catalogue of all numbers (schema/004_identity.sql).
inline constexpr const char* kCatalogueKey = "catalogue";

/// Makes the numbers those of `catalogue`. Numbers of another one are set aside in a fact, and come back when
/// the session meets that catalogue again. Whether any were set aside.
bool turnTo(CatalogueNumbers& numbers, const CatalogueIdentity& catalogue);
/// The same for a session that was just read.
bool turnTo(SavedScan& scan, const CatalogueIdentity& catalogue);

/// Of an open catalogue, for the session with these facts.
[[nodiscard]] Result<CatalogueIdentity> identityOf(ObjectDatabase& database, const SessionMetadata& metadata);

/// Says that the numbers of the session in `folder` were set aside.
[[nodiscard]] Error isAnotherCatalogue(const std::filesystem::path& folder, const std::string& database);

}  // namespace scantrove
