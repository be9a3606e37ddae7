#pragma once
#include <map>
#include <string>

#include "core/editing/operation.h"
#include "core/labeling/region_table.h"

namespace scantrove {

/// A person's labels of a region.
struct RegionNote {
  std::string name = {}, category = {};
  bool background = false;
  bool object = false;    ///< marked as an object, complete or not
  bool rejected = false;  ///< marked as no object

  bool operator==(const RegionNote&) const = default;
};

/// What the note says about the region, for the mapping.
[[nodiscard]] UserLabel userLabelOf(const RegionNote& note);

/// The note after a name, accept, background, object or reject; other operations do not change it.
[[nodiscard]] RegionNote notedBy(const Operation& operation, RegionNote note);

/// The note of a region that another one joined: a name or a category that it lacks comes from there.
[[nodiscard]] RegionNote joinedNote(const RegionNote& into, const RegionNote& from);

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
