#pragma once
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/ids.h"
#include "core/editing/operation_log.h"
#include "core/editing/region_notes.h"
#include "core/labeling/view_coverage.h"

namespace scantrove {

/// What there is to say of a region.
struct RegionInfo {
  RegionId region;
  std::int64_t voxels = 0;
  RegionNote note;
  ObjectId object;              ///< of the catalogue; none: it is not one
  ViewCoverage seen_from = {};  ///< of all its fragments
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
