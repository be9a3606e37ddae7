#pragma once
#include <QString>
#include <vector>

#include "core/base/review_state.h"
#include "core/scan/region_info.h"

namespace scantrove {

/// What a person may still do with a scan.
struct WorkLeft {
  int unnamed_objects = 0;  ///< found ones that nobody named
  ReviewCounts key_frames;
};

/// Counts the objects of a scan that have no name: each object of the catalogue once, and regions that are
/// marked as an object without an entry. Background and rejected regions do not count.
[[nodiscard]] int countUnnamed(const RegionInfos& regions);

/// A step of the work after a scan.
struct NextStep {
  enum class Kind { name, check, export_data };
  Kind kind = Kind::export_data;
  int left = 0;          ///< objects or key frames
  bool is_next = false;  ///< the one to begin with
  bool operator==(const NextStep&) const = default;
};

/// The steps that are left, in order. The last one is always the export.
[[nodiscard]] std::vector<NextStep> nextStepsOf(const WorkLeft& work);

/// "Name 12 found objects"
[[nodiscard]] QString textOf(const NextStep& step);

}  // namespace scantrove
