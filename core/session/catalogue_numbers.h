#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "core/base/result.h"
#include "core/catalogue/object_database.h"
#include "core/session/saved_scan.h"

namespace scantrove {

/// Identifies a catalogue.
struct CatalogueIdentity {
  std::string uuid = {};  ///< ObjectDatabase::identity()
  bool has_session =
      false;  ///< a scan began there when the session did; identifies the catalogue of older sessions
};

/// The ids of a catalogue's objects that a session stores. They are meaningless in another catalogue.
struct CatalogueNumbers {
  SessionMetadata metadata;  ///< of the session; an empty value means no entry
  std::map<RegionId, ObjectId> objects;
};

/// The metadata key for the catalogue of all ids (schema/004_identity.sql).
inline constexpr const char* kCatalogueKey = "catalogue";

/// Makes the ids those of `catalogue`. Ids of another catalogue are set aside in the metadata, and restored
/// when the session is used with that catalogue again. Returns whether any were set aside.
bool turnTo(CatalogueNumbers& numbers, const CatalogueIdentity& catalogue);
/// The same for a session that was just read.
bool turnTo(SavedScan& scan, const CatalogueIdentity& catalogue);

/// For an open catalogue and the session with this metadata.
[[nodiscard]] Result<CatalogueIdentity> identityOf(ObjectDatabase& database, const SessionMetadata& metadata);

/// The message that the ids of the session in `folder` were set aside.
[[nodiscard]] Error isAnotherCatalogue(const std::filesystem::path& folder, const std::string& database);

}  // namespace scantrove
