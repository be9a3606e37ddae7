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

/// The catalogue as a running scan knows it: a CatalogueModel of all objects, the records of the visible
/// ones, and all views in the detector. Read once; then what the scan finds is here at once, and stored by
/// another thread (CatalogueWriter), whose events say what became of it and what others did. One thread, the
/// worker's. More than thirty functions: each change of the model has to reach records, sizes and detector in
/// one step, so they are kept together.
///
/// An object that this scan finds has a key of its own for as long as the scan lasts, whenever the database
/// gives it an id: what a scan does never depends on when that is. All ids here are such keys; for objects
/// that were in the catalogue before, and those of others, key and id are the same.
class CatalogueMirror {
 public:
  static constexpr std::uint32_t kFirstKey = 1U << 31U;  ///< of the objects that a scan finds

  explicit CatalogueMirror(Detector detector) : detector_(std::move(detector)) {}

  /// What a scan that continues knows of its part in the catalogue.
  struct Continued {
    std::int64_t session = 0;                            ///< of the catalogue; 0: none continues
    std::uint32_t next_key = kFirstKey;                  ///< for the next object that is found
    std::map<ObjectId, ObjectId> ids;                    ///< of the scan's objects that are stored, by key
    std::set<std::pair<ObjectId, ObjectId>> kept_apart;  ///< users undid their merges; smaller id first
    std::set<ObjectId> regrouped;                        ///< users brought back, merged or split
  };
  /// Before load().
  void continueSession(Continued earlier);
  /// Of this scan, so far; but for its session.
  [[nodiscard]] Continued continued() const;

  /// Reads all of `database`; returns where its events go on.
  [[nodiscard]] Result<CataloguePosition> load(ObjectDatabase& database);

  [[nodiscard]] const CatalogueModel& model() const { return model_; }
  /// The record of a visible object, or null. Its id is the key.
  [[nodiscard]] const ObjectRecord* record(ObjectId object) const;
  /// The record of what the object is now, after merges, or null.
  [[nodiscard]] const ObjectRecord* currentRecord(ObjectId object) const {
    return record(mergeRootOf(object));
  }
  /// The visible objects that this scan has not found, rising.
  [[nodiscard]] std::vector<ObjectId> ofBefore() const;
  /// CatalogueModel::mergeRoot(), by index.
  [[nodiscard]] ObjectId mergeRootOf(ObjectId object) const { return detector_.mergeRootOf(object); }
  /// Others deleted, restored or merged it, or undid a merge.
  [[nodiscard]] bool isRegrouped(ObjectId object) const { return regrouped_.contains(object); }
  [[nodiscard]] Detector& detector() { return detector_; }
  /// Where earlier scans saw what is in it.
  [[nodiscard]] KnownLayouts& places() { return places_; }
  [[nodiscard]] const KnownLayouts& places() const { return places_; }

  /// This scan found the object.
  [[nodiscard]] static bool isOfThisScan(ObjectId key) { return key.value >= kFirstKey; }
  /// None: not stored yet.
  [[nodiscard]] ObjectId idOf(ObjectId key) const;
  [[nodiscard]] ObjectId keyOf(ObjectId id) const;

  // What the scan does, ahead of the database.

  /// For the next object that is found.
  [[nodiscard]] ObjectId nextKey() { return ObjectId{next_key_++}; }
  /// An unknown object, by the key `first_view.object`.
  void add(const ObjectView& first_view);
  /// Another view of view.object, or of what that was merged into.
  void addView(const ObjectView& view);
  /// Two visible objects are one.
  void merge(ObjectId a, ObjectId b);
  /// CatalogueModel::nameByUser().
  void name(ObjectId object, const std::string& name);
  /// An object that was made for an operation of a user, who undid it: it is none any more, unless others are
  /// part of it. Its names were part of that operation.
  void withdraw(ObjectId object);
  /// Whether there is or was such an object.
  [[nodiscard]] bool hasHad(ObjectId object) const { return model_.find(object) != nullptr; }

  /// What the database made of it, and what others did.
  void apply(const CatalogueEvent& event);

 private:
  struct Applied;

  void put(const ObjectState& of_database);
  void setHidden(ObjectId object);
  /// All roots, after states have come from the database.
  void updateRoots();
  /// Records and roots follow what the model's operations changed.
  void followModel();
  void join(ObjectId into, ObjectId from);
  void addDescriptor(const StoredDescriptor& view);
  void addSize(ObjectId object, const Eigen::Vector3f& size_m);
  void putRecord(ObjectRecord record);
  [[nodiscard]] Eigen::Vector3f sizeOf(ObjectId root) const;
  /// Views that the object has and the database does not have yet.
  [[nodiscard]] int viewsToCome(ObjectId root) const;
  void edit(const CatalogueEdits& edits);
  void applyName(ObjectId object, const std::string& name);
  /// What the database does not know yet holds all the same.
  void applyToCome();

  Detector detector_;
  KnownLayouts places_;
  CatalogueModel model_;
  std::unordered_map<ObjectId, ObjectRecord> records_;                // of visible objects
  std::unordered_map<ObjectId, std::vector<Eigen::Vector3f>> sizes_;  // of the views, by first object
  std::set<ObjectId> regrouped_;

  std::int64_t session_ = 0;  // of the catalogue, that continues; 0: none does
  std::uint32_t next_key_ = kFirstKey;
  std::unordered_map<ObjectId, ObjectId> ids_, keys_;            // of this scan's objects that are stored
  std::map<ObjectId, int> views_to_come_;                        // by first object
  std::vector<std::pair<ObjectId, ObjectId>> merges_to_come_;    // in order
  std::vector<std::pair<ObjectId, std::string>> names_to_come_;  // likewise
};

}  // namespace scantrove
