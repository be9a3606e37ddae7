#pragma once
#include <map>
#include <string>

#include "core/base/ids.h"

namespace scantrove {

/// A person's labels of a region.
struct RegionNote {
  std::string name, category;
  bool background = false;
  bool object = false;    ///< marked as an object, complete or not
  bool rejected = false;  ///< marked as no object

  bool operator==(const RegionNote&) const = default;
};

/// The notes of all regions. A region that no longer exists keeps its note, because an undo may restore it.
/// One thread.
class RegionNotes {
 public:
  /// The region's note, or an empty one.
  [[nodiscard]] const RegionNote& of(RegionId region) const;
  /// An empty note removes the region's entry.
  void set(RegionId region, const RegionNote& note);
  [[nodiscard]] const std::map<RegionId, RegionNote>& all() const { return notes_; }

 private:
  std::map<RegionId, RegionNote> notes_;  // none is empty
};

}  // namespace scantrove
