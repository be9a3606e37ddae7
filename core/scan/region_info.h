#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/ids.h"
#include "core/editing/operation_log.h"
#include "core/editing/region_notes.h"
#include "core/geometry/view_coverage.h"
#include "core/session/region_label.h"

namespace scantrove {

/// What there is to say of a region.
struct RegionInfo {
  RegionId region;
  std::int64_t voxels = 0;
  RegionNote note;
  ObjectId object;              ///< of the catalogue; none: it is not one
  ViewCoverage seen_from = {};  ///< of all its fragments
  /// What is to be said of it; none: what the note says.
  std::optional<RegionLabel> label = {};

  /// As a person calls it, here or in the catalogue; empty: nobody does.
  [[nodiscard]] std::string name() const {
    if (!label) return note.name;
    return label->is_named ? label->name : std::string();
  }
  [[nodiscard]] std::string category() const { return label ? label->category : note.category; }
};

/// All regions of a scan, by rising id.
using RegionInfos = std::vector<RegionInfo>;

/// Null: there is no such region.
[[nodiscard]] inline const RegionInfo* find(const RegionInfos& infos, RegionId region) {
  const auto place = std::ranges::lower_bound(infos, region, {}, &RegionInfo::region);
  return place != infos.end() && place->region == region ? &*place : nullptr;
}

/// An operation of the log, in brief.
struct DoneOperation {
  int number = 0;
  OperationKind kind = OperationKind::name;
  std::vector<RegionId> regions;
  std::string name;
  bool on = true;
  OperationLog::State state = OperationLog::State::done;
};

}  // namespace scantrove
