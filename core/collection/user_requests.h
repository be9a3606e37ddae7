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

/// Requests of users: a region is to become an object, or gets a name. A request waits until the region is
/// seen; each can be undone.
class UserRequests {
 public:
  /// The part that a session stores.
  struct State {
    std::map<RegionId, GivenName> pending;     ///< regions that wait to become objects; names, or empty
    std::map<RegionId, ObjectId> not_objects;  ///< a user said that the region is not this object
    std::set<ObjectId> requested;              ///< objects added by request
  };

  /// All outlive this.
  UserRequests(CatalogueMirror& catalogue, CatalogueWriter& writer, ObjectTracks& tracks, State state = {})
      : catalogue_(catalogue), writer_(writer), tracks_(tracks), state_(std::move(state)) {}
  [[nodiscard]] const State& state() const { return state_; }

  // Edits of users.

  /// The region is an object. If it is none yet, it is added when it is seen next, complete or not, with
  /// the name if there is one.
  void request(RegionId region, const GivenName& given);
  /// The region is no object, or its request is cancelled.
  void cancel(RegionId region);
  /// Regions with a pending request.
  [[nodiscard]] const std::map<RegionId, GivenName>& pending() const { return state_.pending; }

  /// Names the object of the region, which confirms it. If the catalogue has another object of that name,
  /// the two are merged. The object gets the given class, which is made if there is none; one that is no
  /// valid name is left out (takeRefusal). A region that is no object becomes one only by request().
  void name(RegionId region, const GivenName& given);
  /// Redoes an undone name. Changes that others made to the object meanwhile stay.
  void redoName(RegionId region, const GivenName& given);
  /// Undoes the newest such name() in the catalogue, unless somebody has renamed the object since.
  void undoName(RegionId region, const std::string& name);
  /// Undoes that the region is an object: removes an object that was made for the request.
  void undoObject(RegionId region);
  /// Whether this scan named the region so, and that was not undone.
  [[nodiscard]] bool hasNamed(RegionId region, const std::string& name) const;

  /// Namings by earlier scans of this session, so that they can be undone here.
  void restoreNamings(RegionId region, const std::vector<StoredNaming>& stored);
  /// Namings of regions by this and earlier scans, as far as they are stored and not undone.
  [[nodiscard]] std::map<RegionId, std::vector<StoredNaming>> storedNamings() const;

  // Fulfilment.

  /// A candidate of these regions is requested.
  [[nodiscard]] bool isRequested(const RegionSet& regions) const;
  /// The requested name of a candidate with one requested region; null: there is no such request.
  [[nodiscard]] const std::string* requestedName(const Candidate& candidate) const;
  /// A user said that the region is not this object.
  [[nodiscard]] bool isExcluded(RegionId region, ObjectId object) const;
  enum class MadeFor { itself, request };
  /// The candidate is now this object. `made`: the object was added only by request.
  void complete(const Candidate& candidate, ObjectId object, MadeFor made);
  /// `from` is now part of `into`.
  void joinRegions(RegionId into, RegionId from);
  /// The database has stored a name.
  void noteStored(const event::NameStored& stored);
  /// The oldest name that the catalogue refused; returned once.
  [[nodiscard]] std::optional<Error> takeRefusal();

  /// The object was added by request.
  [[nodiscard]] bool isRequested(ObjectId object) const { return state_.requested.contains(object); }
  /// A user edited or deleted the object.
  [[nodiscard]] bool isEdited(ObjectId object) const;
  /// Refinement does not change the object: a user edited it, or an earlier scan found it.
  [[nodiscard]] bool isFixed(ObjectId object) const;
  /// The object of the region is fixed.
  [[nodiscard]] bool isFixed(RegionId region) const;

 private:
  struct Naming {
    int number = 0;
    RegionId region;
    std::string name;  // empty: the region becomes an object without a name
    ObjectId earlier;  // the region's former object, if it has another now
    ObjectId made;     // the object added for this request; none: it existed
    std::optional<ObjectNaming> stored = {};
    bool is_of_earlier_scan = false;
  };
  using Namings = std::vector<Naming>;

  void applyName(RegionId region, const GivenName& given, int again);
  /// Without a class that is not valid; the catalogue refuses that.
  [[nodiscard]] GivenName withValidClass(GivenName given);
  /// The names that users gave the other regions of its object.
  [[nodiscard]] std::vector<std::string> namesOfOthers(RegionId region) const;
  [[nodiscard]] Namings::iterator newest(RegionId region, const std::string& name);
  void undo(Namings::iterator naming);

  CatalogueMirror& catalogue_;
  CatalogueWriter& writer_;
  ObjectTracks& tracks_;
  State state_;
  Namings namings_;  // not undone
  Namings undone_;   // newest last
  int last_naming_ = 0;
  std::vector<Error> refusals_;
};

}  // namespace scantrove
