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

/// What the catalogue did for one edit, as the session is to keep it.
struct CatalogueOutcome {
  SessionMetadata metadata;
  std::map<RegionId, ObjectId> objects;  ///< none: the region is none any more
  std::vector<Error> refusals;           ///< what cannot be done, now or later

  [[nodiscard]] std::string toJson() const;
  /// Error: it was not written so.
  [[nodiscard]] static Result<CatalogueOutcome> fromJson(const std::string& text);
};

/// Carries one edit of a session out in its catalogue, as one transaction there. The session is only read.
/// Thread of both; may throw cl::Error.
class CatalogueEdit {
 public:
  /// Both outlive it.
  CatalogueEdit(OpenSession& session, ObjectDatabase& database) : session_(session), database_(database) {}

  /// Error: it cannot be done for now; nothing was changed.
  [[nodiscard]] Result<CatalogueOutcome> carryOut(const PendingEdit& edit);

 private:
  [[nodiscard]] Result<std::string> run(const PendingEdit& edit);
  [[nodiscard]] Result<void> runStep(const CatalogueStep& step);
  [[nodiscard]] Result<void> name(const CatalogueStep& step);
  [[nodiscard]] Result<void> redoName(const CatalogueStep& step);
  [[nodiscard]] Result<void> revertName(const CatalogueStep& step);
  [[nodiscard]] Result<void> add(RegionId region);
  /// Takes the newest entry of that name back. False: there is none.
  [[nodiscard]] Result<bool> revert(RegionId region, const std::string& name);

  /// Names the region's object, or one that is made for it.
  [[nodiscard]] Result<std::optional<StoredNaming>> nameObjectOf(RegionId region, const std::string& name);
  /// A new object for the region; one that was made for it, and went with an undo, comes back. None: refused.
  [[nodiscard]] Result<ObjectId> objectFor(RegionId region);
  [[nodiscard]] Result<ObjectId> makeFromKeyFrames(RegionId region);
  /// What users call the other regions of that object.
  [[nodiscard]] std::vector<std::string> namesOfOthers(RegionId region, ObjectId object);
  /// The object that the region is now; none: it is none, or was deleted.
  [[nodiscard]] ObjectId presentObjectOf(RegionId region);

  // The session as this edit leaves it.
  [[nodiscard]] ObjectId objectOf(RegionId region) const;
  void setObject(RegionId region, ObjectId object) { outcome_.objects[region] = object; }
  [[nodiscard]] std::string fact(const std::string& name) const;
  [[nodiscard]] std::vector<StoredNaming> kept(const std::string& key) const {
    return namingsFromJson(fact(key));
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
  /// Cut from the key frames before the transaction: nobody waits for that. A region without an entry was not
  /// needed so far.
  std::map<RegionId, std::vector<ObjectView>> views_;
  RegionId without_views_;  // the transaction was left for these
};

}  // namespace scantrove
