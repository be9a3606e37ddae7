#include "core/editing/region_notes.h"

namespace scantrove {

const RegionNote& RegionNotes::of(RegionId region) const {
  static const RegionNote kNothing;
  const auto found = notes_.find(region);
  return found == notes_.end() ? kNothing : found->second;
}

void RegionNotes::set(RegionId region, const RegionNote& note) {
  if (note == RegionNote{}) {
    notes_.erase(region);
  } else {
    notes_[region] = note;
  }
}

}  // namespace scantrove
