#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/object_database.h"
#include "core/catalogue/stored_namings.h"
#include "core/session/open_session.h"
#include "core/session/pending_edits.h"

namespace scantrove {

/// The result of one edit in the catalogue, for the session to store.
struct CatalogueOutcome {
  SessionMetadata metadata;
  std::map<RegionId, ObjectId> objects;  ///< none: the region is no object any more
  std::vector<Error> refusals;           ///< operations that cannot be done now or later

  [[nodiscard]] std::string toJson() const;
  /// Error: malformed text.
  [[nodiscard]] static Result<CatalogueOutcome> fromJson(const std::string& text);
};

/// Executes one edit of a session in its catalogue, as one transaction. The session is only read. Thread of
/// both; may throw cl::Error.
class CatalogueEdit {
 public:
  /// Both outlive this.
  CatalogueEdit(OpenSession& session, ObjectDatabase& database) : session_(session), database_(database) {}

  /// Error: not possible now; nothing was changed.
  [[nodiscard]] Result<CatalogueOutcome> carryOut(const PendingEdit& edit);

 private:
  [[nodiscard]] Result<std::string> run(const PendingEdit& edit);
  [[nodiscard]] Result<void> runStep(const CatalogueStep& step);
  [[nodiscard]] Result<void> name(const CatalogueStep& step);
  [[nodiscard]] Result<void> redoName(const CatalogueStep& step);
  [[nodiscard]] Result<void> revertName(const CatalogueStep& step);
  [[nodiscard]] Result<void> add(RegionId region);
  /// Reverts the newest entry of that name. False: there is none.
  [[nodiscard]] Result<bool> revert(RegionId region, const std::string& name);

  /// Names the region's object, or a new one made for it.
  [[nodiscard]] Result<std::optional<StoredNaming>> nameObjectOf(RegionId region, const GivenName& given);
  /// A new object for the region, or the one that an undo removed. None: refused.
  [[nodiscard]] Result<ObjectId> objectFor(RegionId region);
  [[nodiscard]] Result<ObjectId> makeFromKeyFrames(RegionId region);
  /// The names that users gave the other regions of that object.
  [[nodiscard]] std::vector<std::string> namesOfOthers(RegionId region, ObjectId object);
  /// The current object of the region; none: it has none, or it was deleted.
  [[nodiscard]] ObjectId presentObjectOf(RegionId region);

  // The session's data after this edit.
  [[nodiscard]] ObjectId objectOf(RegionId region) const;
  void setObject(RegionId region, ObjectId object) { outcome_.objects[region] = object; }
  [[nodiscard]] std::string metadata(const std::string& name) const;
  [[nodiscard]] std::vector<StoredNaming> kept(const std::string& key) const {
    return namingsFromJson(metadata(key));
  }
  void keep(const std::string& key, const std::vector<StoredNaming>& namings) {
    outcome_.metadata[key] = namingsToJson(namings);
  }
  void refuse(std::string what, std::string advice) {
    outcome_.refusals.push_back({std::move(what), std::move(advice)});
  }

  OpenSession& session_;
  ObjectDatabase& database_;
  CatalogueOutcome outcome_;
  /// Cropped from the key frames before the transaction, to keep it short. Regions without an entry were
  /// not needed so far.
  std::map<RegionId, std::vector<ObjectView>> views_;
  RegionId without_views_;  // the transaction was aborted to crop views of this region
};

}  // namespace scantrove
