#include "core/editing/region_notes.h"

namespace scantrove {

UserLabel userLabelOf(const RegionNote& note) {
  if (!note.name.empty() || note.object) return UserLabel::object;
  return note.background || note.rejected ? UserLabel::background : UserLabel::nothing;
}

RegionNote notedBy(const Operation& operation, RegionNote note) {
  if (operation.kind == OperationKind::background) {
    note.background = operation.on;
  } else if (operation.kind == OperationKind::object) {
    // A region unmarked as an object is left out of lists and data sets, even if the program found it.
    note.object = operation.on;
    note.rejected = !operation.on;
    if (operation.on) note.background = false;
  } else if (operation.kind == OperationKind::reject) {
    note.rejected = operation.on;
    if (operation.on) note.object = false;
  } else if (isNaming(operation.kind)) {
    note.name = operation.name;
    note.category = operation.category;
    note.rejected = false;
    // A named region is an object, so that data sets hold what the catalogue holds.
    if (!operation.name.empty()) note.background = false;
  }
  return note;
}

RegionNote joinedNote(const RegionNote& into, const RegionNote& from) {
  if (into == RegionNote{}) return from;
  RegionNote note = into;
  if (note.background || note.rejected || from.background || from.rejected) return note;
  if (note.name.empty()) {
    note.name = from.name;
    if (!from.category.empty()) note.category = from.category;
  } else if (note.category.empty()) {
    note.category = from.category;
  }
  return note;
}

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
