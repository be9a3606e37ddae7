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

/// The description of a region for the window.
struct RegionInfo {
  RegionId region;
  std::int64_t voxels = 0;
  RegionNote note;
  ObjectId object;              ///< in the catalogue; none: it is no object
  ViewCoverage seen_from = {};  ///< all its fragments together
  /// Its label; none: the note applies.
  std::optional<RegionLabel> label = {};
  bool is_proposed_background = false;  ///< isProposedBackground()

  /// The name that a user gave, here or in the catalogue; empty: none.
  [[nodiscard]] std::string name() const {
    if (!label) return note.name;
    return label->is_named ? label->name : std::string();
  }
  [[nodiscard]] std::string category() const { return label ? label->category : note.category; }
};

/// All regions of a scan, by ascending id.
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
  std::optional<FrameReview> review = {};  ///< of a review
};

}  // namespace scantrove
