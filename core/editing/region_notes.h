#pragma once
#include <map>
#include <string>

#include "core/base/ids.h"

namespace scantrove {

/// What a person said of a region.
struct RegionNote {
  std::string name, category;
  bool background = false;
  bool object = false;    ///< it is one, whole or not
  bool rejected = false;  ///< it is none

  bool operator==(const RegionNote&) const = default;
};

/// What was said of each region. A region that is no more keeps its note: it may come back by an undo. One
/// thread.
class RegionNotes {
 public:
  /// An empty note where nothing was said.
  [[nodiscard]] const RegionNote& of(RegionId region) const;
  /// An empty note takes everything back.
  void set(RegionId region, const RegionNote& note);
  [[nodiscard]] const std::map<RegionId, RegionNote>& all() const { return notes_; }

 private:
  std::map<RegionId, RegionNote> notes_;  // none is empty
};

}  // namespace scantrove
