#pragma once
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/catalogue_event.h"
#include "core/catalogue/catalogue_model.h"
#include "core/catalogue/detector.h"
#include "core/catalogue/known_layouts.h"
#include "core/catalogue/object_database.h"

namespace scantrove {

/// The catalogue in memory for a running scan: a CatalogueModel of all objects and classes, the records of
/// the visible ones, and all views in the detector. It is read once. The scan's objects are added at once;
/// CatalogueWriter stores them on another thread, and its events report the outcome and the changes by
/// others. One thread, the worker's. More than thirty functions: each change of the model must reach
/// records, sizes and detector in one step, so they are kept together.
///
/// Each object that this scan finds has its own key during the scan, so that no result depends on when the
/// database assigns an id. All ids here are such keys. For objects that existed before, and for those of
/// others, key and id are the same.
class CatalogueMirror {
 public:
  static constexpr std::uint32_t kFirstKey = 1U << 31U;  ///< of the objects that a scan finds

  explicit CatalogueMirror(Detector detector) : detector_(std::move(detector)) {}

  /// What a continued scan knows of its part in the catalogue.
  struct Continued {
    std::int64_t session = 0;                            ///< of the catalogue; 0: none continues
    std::uint32_t next_key = kFirstKey;                  ///< for the next new object
    std::map<ObjectId, ObjectId> ids;                    ///< of the scan's stored objects, by key
    std::set<std::pair<ObjectId, ObjectId>> kept_apart;  ///< users undid their merges; smaller id first
    std::set<ObjectId> merge_edited;                     ///< objects that users restored, merged or split
  };
  /// Must precede load().
  void continueSession(Continued earlier);
  /// State of this scan so far, without its session.
  [[nodiscard]] Continued continued() const;

  /// Reads all of `database`; returns the position from which its events continue.
  [[nodiscard]] Result<CataloguePosition> load(ObjectDatabase& database);

  [[nodiscard]] const CatalogueModel& model() const { return model_; }
  /// The record of a visible object, or null. Its id is the key.
  [[nodiscard]] const ObjectRecord* record(ObjectId object) const;
  /// The record of the object's merge root, or null.
  [[nodiscard]] const ObjectRecord* currentRecord(ObjectId object) const {
    return record(mergeRootOf(object));
  }
  /// The visible objects that existed before this scan, ascending.
  [[nodiscard]] std::vector<ObjectId> earlierObjects() const;
  /// CatalogueModel::mergeRoot(), from an index.
  [[nodiscard]] ObjectId mergeRootOf(ObjectId object) const { return detector_.mergeRootOf(object); }
  /// Whether others deleted, restored or merged the object, or undid a merge.
  [[nodiscard]] bool isMergeEdited(ObjectId object) const { return merge_edited_.contains(object); }
  [[nodiscard]] Detector& detector() { return detector_; }
  /// Object positions in earlier scans.
  [[nodiscard]] KnownLayouts& places() { return places_; }
  [[nodiscard]] const KnownLayouts& places() const { return places_; }

  /// Whether this scan found the object.
  [[nodiscard]] static bool isOfThisScan(ObjectId key) { return key.value >= kFirstKey; }
  /// None: not stored yet.
  [[nodiscard]] ObjectId idOf(ObjectId key) const;
  [[nodiscard]] ObjectId keyOf(ObjectId id) const;

  // Changes by the scan, ahead of the database.

  /// For the next new object.
  [[nodiscard]] ObjectId nextKey() { return ObjectId{next_key_++}; }
  /// Adds an unknown object with the key `first_view.object`.
  void add(const ObjectView& first_view);
  /// Adds another view of view.object, or of its merge root.
  void addView(const ObjectView& view);
  /// Merges two visible objects.
  void merge(ObjectId a, ObjectId b);
  /// CatalogueModel::nameByUser().
  void name(ObjectId object, const GivenName& given);
  /// Removes an object that was made for an operation which a user undid, unless others are merged into it.
  /// Its names are undone with it.
  void withdraw(ObjectId object);
  /// Whether such an object exists or existed.
  [[nodiscard]] bool hasHad(ObjectId object) const { return model_.find(object) != nullptr; }

  /// Applies an outcome of the database, or changes by others.
  void apply(const CatalogueEvent& event);

 private:
  struct Applied;

  void put(const ObjectState& of_database);
  void setHidden(ObjectId object);
  /// Updates all roots after states were read from the database.
  void updateRoots();
  /// Updates records and roots after operations of the model.
  void updateFromModel();
  void join(ObjectId into, ObjectId from);
  void addDescriptor(const StoredDescriptor& view);
  void addSize(ObjectId object, const Eigen::Vector3f& size_m);
  void putRecord(ObjectRecord record);
  [[nodiscard]] Eigen::Vector3f sizeOf(ObjectId root) const;
  /// Number of the object's views that the database does not have yet.
  [[nodiscard]] int pendingViews(ObjectId root) const;
  void edit(const CatalogueEdits& edits);
  void applyName(ObjectId object, const GivenName& given);
  /// Applies changes again that the database does not have yet.
  void applyPending();

  Detector detector_;
  KnownLayouts places_;
  CatalogueModel model_;
  std::unordered_map<ObjectId, ObjectRecord> records_;                // of visible objects
  std::unordered_map<ObjectId, std::vector<Eigen::Vector3f>> sizes_;  // of the views, by first object
  std::set<ObjectId> merge_edited_;

  std::int64_t session_ = 0;  // the catalogue's session that continues; 0: none
  std::uint32_t next_key_ = kFirstKey;
  std::unordered_map<ObjectId, ObjectId> ids_, keys_;          // of this scan's stored objects
  std::map<ObjectId, int> pending_views_;                      // by first object
  std::vector<std::pair<ObjectId, ObjectId>> pending_merges_;  // in order
  std::vector<std::pair<ObjectId, GivenName>> pending_names_;  // likewise
};

}  // namespace scantrove
