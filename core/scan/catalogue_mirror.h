#pragma once
#include <cstdint>
#include <set>
#include <unordered_map>
#include <utility>

#include "core/base/result.h"
#include "core/catalog/detector.h"
#include "core/catalog/object_database.h"

namespace scantrove {

/// The catalogue as a scan knows it: the visible objects' records, who holds what, and all views in the
/// detector. Read once, then kept up to date change by change, whoever made them. One thread, the worker's.
class CatalogueMirror {
 public:
  /// The database outlives the mirror.
  CatalogueMirror(ObjectDatabase& database, Detector detector)
      : database_(database), detector_(std::move(detector)) {}

  [[nodiscard]] Result<void> load();

  /// Learns what happened since the last call: far below a millisecond when nothing did, or when a person
  /// renamed or confirmed. On an error nothing is lost: the next call goes on.
  [[nodiscard]] Result<void> follow();

  /// The record of a visible object, or null.
  [[nodiscard]] const ObjectRecord* record(ObjectId object) const;
  /// Who holds what was this object's; none: it was deleted.
  [[nodiscard]] ObjectId holderOf(ObjectId object) const { return detector_.holderOf(object); }
  /// A person took a merge of these two back.
  [[nodiscard]] bool areKeptApart(ObjectId a, ObjectId b) const {
    return kept_apart_.contains(std::minmax(a, b));
  }
  [[nodiscard]] Detector& detector() { return detector_; }

  /// What this scan has just stored, ahead of follow(): a new object, another view of one.
  void noteAdded(const ObjectRecord& record);
  void noteView(ObjectId holder) { ++records_.at(holder).views; }

 private:
  struct Effects;
  [[nodiscard]] Result<void> loadHolders();
  [[nodiscard]] Result<void> loadViews();
  [[nodiscard]] Result<void> readRecord(ObjectId object);

  ObjectDatabase& database_;
  Detector detector_;
  std::unordered_map<ObjectId, ObjectRecord> records_;
  std::set<std::pair<ObjectId, ObjectId>> kept_apart_;  // smaller id first
  std::int64_t last_event_ = 0;                         // that was followed
  std::int64_t last_view_ = 0;                          // that the detector has
};

}  // namespace scantrove
