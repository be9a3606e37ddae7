#pragma once
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/catalogue_event.h"
#include "core/catalogue/catalogue_mirror.h"
#include "core/catalogue/catalogue_writer.h"
#include "core/catalogue/stored_namings.h"
#include "core/collection/object_tracks.h"
#include "core/discovery/candidate.h"

namespace scantrove {

/// What a user asks of regions: that a region becomes an object, and what it is called. A request waits until
/// the region is seen; each can be undone.
class UserRequests {
 public:
  /// What a session keeps.
  struct State {
    std::map<RegionId, std::string> pending;   ///< regions that wait to become objects; names, or empty
    std::map<RegionId, ObjectId> not_objects;  ///< a user said that the region is another than this object
    std::set<ObjectId> requested;              ///< objects that were waited for
  };

  /// All outlive the requests.
  UserRequests(CatalogueMirror& catalogue, CatalogueWriter& writer, ObjectTracks& tracks, State state = {})
      : catalogue_(catalogue), writer_(writer), tracks_(tracks), state_(std::move(state)) {}
  [[nodiscard]] const State& state() const { return state_; }

  // What a user does.

  /// The region is an object. If it is none yet, it is added when it is seen next, complete or not, and gets
  /// the `name` if there is one.
  void request(RegionId region, const std::string& name);
  /// The region is no object, or nothing more is asked of it.
  void cancel(RegionId region);
  /// Regions that are waited for.
  [[nodiscard]] const std::map<RegionId, std::string>& pending() const { return state_.pending; }

  /// The region is called so: its object gets the name, and is confirmed. If the catalogue has another object
  /// of that name, the two become one. If the region is no object, only request() makes it one.
  void name(RegionId region, const std::string& name);
  /// The same for a name that was undone. What others made of its object meanwhile stays.
  void redoName(RegionId region, const std::string& name);
  /// Undoes the newest such name() in the catalogue, unless somebody has named the object otherwise since.
  void undoName(RegionId region, const std::string& name);
  /// Undoes that the region is an object: one that was made for that is removed.
  void undoObject(RegionId region);
  /// Whether this scan named the region so, and that was not undone.
  [[nodiscard]] bool hasNamed(RegionId region, const std::string& name) const;

  /// What namings of earlier scans of this session did, so that they can be undone here.
  void restoreNamings(RegionId region, const std::vector<StoredNaming>& stored);
  /// What namings of regions did, here and in earlier scans, as far as it is stored and not undone.
  [[nodiscard]] std::map<RegionId, std::vector<StoredNaming>> storedNamings() const;

  // What becomes of it.

  /// A candidate of these regions is waited for.
  [[nodiscard]] bool isRequested(const RegionSet& regions) const;
  /// What the user calls the candidate, if its one region is waited for; null: it is not.
  [[nodiscard]] const std::string* requestedName(const Candidate& candidate) const;
  /// A user said that the region is not this object.
  [[nodiscard]] bool isExcluded(RegionId region, ObjectId object) const;
  enum class MadeFor { itself, request };
  /// The candidate is now this object. `made`: whether the object was made only because a user asked for it.
  void complete(const Candidate& candidate, ObjectId object, MadeFor made);
  /// `from` is now part of `into`.
  void joinRegions(RegionId into, RegionId from);
  /// The database has stored a name.
  void noteStored(const event::NameStored& stored);
  /// The oldest name that the catalogue refuses, once.
  [[nodiscard]] std::optional<Error> takeRefusal();

  /// A user waited for the object.
  [[nodiscard]] bool isRequested(ObjectId object) const { return state_.requested.contains(object); }
  /// A user edited the object, or deleted it.
  [[nodiscard]] bool isEdited(ObjectId object) const;
  /// The refinement leaves the object as it is: a user edited it, or an earlier scan found it.
  [[nodiscard]] bool isFixed(ObjectId object) const;
  /// The object of the region is fixed.
  [[nodiscard]] bool isFixed(RegionId region) const;

 private:
  struct Naming {
    int number = 0;
    RegionId region;
    std::string name;  // empty: it is an object
    ObjectId earlier;  // what the region was before, if it is another object now
    ObjectId made;     // for this alone; none: it was there
    std::optional<ObjectNaming> stored = {};
    bool is_of_earlier_scan = false;
  };
  using Namings = std::vector<Naming>;

  void applyName(RegionId region, const std::string& name, int again);
  /// What users call the other regions of its object.
  [[nodiscard]] std::vector<std::string> namesOfOthers(RegionId region) const;
  [[nodiscard]] Namings::iterator newest(RegionId region, const std::string& name);
  void undo(Namings::iterator naming);

  CatalogueMirror& catalogue_;
  CatalogueWriter& writer_;
  ObjectTracks& tracks_;
  State state_;
  Namings namings_;  // that are not undone
  Namings undone_;   // the newest last
  int last_naming_ = 0;
  std::vector<Error> refusals_;
};

}  // namespace scantrove
