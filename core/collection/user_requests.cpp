#include "core/collection/user_requests.h"

#include <algorithm>
#include <iterator>

#include "core/base/label_name.h"
#include "core/catalogue/object_database.h"
#include "core/catalogue/region_object.h"

namespace scantrove {

void UserRequests::request(RegionId region, const GivenName& given) {
  if (tracks_.existingObjectOf(region)) return cancel(region);
  tracks_.bind({region}, {});
  const Result<std::string> checked = checkedLabelName(given.name);
  state_.pending[region] = checked ? GivenName{*checked, given.class_name} : GivenName();
}

GivenName UserRequests::withValidClass(GivenName given) {
  if (given.class_name.empty()) return given;
  const Result<std::string> checked = checkedLabelName(given.class_name);
  if (!checked)
    refusals_.push_back(
        {"The catalogue has no class of the name that the region got. " + checked.error().what,
         checked.error().advice});
  given.class_name = checked ? *checked : std::string();
  return given;
}

void UserRequests::cancel(RegionId region) { state_.pending.erase(region); }

bool UserRequests::isRequested(const RegionSet& regions) const {
  return std::ranges::any_of(state_.pending, [&](const auto& request) {
    // A name belongs to the region alone.
    return regions.contains(request.first) && (request.second.name.empty() || regions.size() == 1);
  });
}

const std::string* UserRequests::requestedName(const Candidate& candidate) const {
  if (candidate.regions.size() != 1) return nullptr;
  const auto found = state_.pending.find(*candidate.regions.begin());
  return found == state_.pending.end() ? nullptr : &found->second.name;
}

bool UserRequests::isExcluded(RegionId region, ObjectId object) const {
  const auto found = state_.not_objects.find(region);
  return found != state_.not_objects.end() && found->second == object;
}

void UserRequests::joinRegions(RegionId into, RegionId from) {
  const auto found = state_.pending.find(from);
  if (found == state_.pending.end()) return;
  state_.pending.try_emplace(into, found->second);
  state_.pending.erase(found);
}

std::vector<std::string> UserRequests::namesOfOthers(RegionId region) const {
  const ObjectId root = catalogue_.mergeRootOf(tracks_.existingObjectOf(region));
  std::map<RegionId, std::string> names;  // current names
  for (const Naming& naming : namings_) {
    if (!naming.name.empty()) names[naming.region] = naming.name;
  }
  std::vector<std::string> others;
  for (const auto& [other, name] : names) {
    if (other != region && catalogue_.mergeRootOf(tracks_.existingObjectOf(other)) == root)
      others.push_back(name);
  }
  return others;
}

void UserRequests::name(RegionId region, const GivenName& given) { applyName(region, given, 0); }

void UserRequests::redoName(RegionId region, const GivenName& given) {
  const Result<std::string> checked = checkedLabelName(given.name);
  const auto newest = std::find_if(undone_.rbegin(), undone_.rend(), [&](const Naming& naming) {
    return naming.region == region && checked && naming.name == *checked;
  });
  const int again = newest == undone_.rend() ? 0 : newest->number;
  if (again != 0) undone_.erase(std::next(newest).base());
  applyName(region, given, again);
}

void UserRequests::applyName(RegionId region, const GivenName& given, int again) {
  const Result<std::string> checked = checkedLabelName(given.name);
  if (!checked) {
    refusals_.push_back(
        {"The catalogue has no object of the name that the region got. " + checked.error().what,
         checked.error().advice});
    return;
  }
  const ObjectId object = tracks_.existingObjectOf(region);
  if (!object) return;
  if (isAnotherObject(catalogue_.model(), object, *checked, namesOfOthers(region))) {
    tracks_.bind({region}, {});
    state_.not_objects[region] = object;
    return;
  }
  namings_.push_back({++last_naming_, region, *checked, {}, {}});
  const GivenName valid = withValidClass({*checked, given.class_name});
  catalogue_.name(object, valid);
  writer_.name(last_naming_, object, valid, again);
}

bool UserRequests::hasNamed(RegionId region, const std::string& name) const {
  const Result<std::string> checked = checkedLabelName(name);
  return checked && std::ranges::any_of(namings_, [&](const Naming& naming) {
           return naming.region == region && naming.name == *checked;
         });
}

void UserRequests::noteStored(const event::NameStored& stored) {
  const auto found = std::ranges::find(namings_, stored.number, &Naming::number);
  if (found != namings_.end()) found->stored = stored.naming;
}

std::optional<Error> UserRequests::takeRefusal() {
  if (refusals_.empty()) return std::nullopt;
  Error oldest = std::move(refusals_.front());
  refusals_.erase(refusals_.begin());
  return oldest;
}

std::map<RegionId, std::vector<StoredNaming>> UserRequests::storedNamings() const {
  std::map<RegionId, std::vector<StoredNaming>> all;
  for (const Naming& naming : namings_) {
    // If the object existed and has the name now, the region was that object before.
    const bool was_there = !naming.earlier && !naming.made && !naming.is_of_earlier_scan;
    const ObjectId earlier = was_there ? tracks_.objectOf(naming.region) : naming.earlier;
    const ObjectId made = catalogue_.idOf(naming.made);
    std::optional<ObjectNaming> stored = naming.stored;
    if (naming.name.empty() && made) stored = ObjectNaming{made, {}, {}};
    if (stored) all[naming.region].push_back({*stored, catalogue_.idOf(earlier), made});
  }
  return all;
}

void UserRequests::restoreNamings(RegionId region, const std::vector<StoredNaming>& stored) {
  const auto isKnown = [this](ObjectId object) { return catalogue_.hasHad(object); };
  for (const StoredNaming& one : stored) {
    const std::optional<ObjectMerge>& merge = one.naming.merge;
    if (!isKnown(one.naming.object) || (merge && !std::ranges::all_of(merge->from, isKnown))) continue;
    namings_.push_back({++last_naming_, region, one.naming.name, one.earlier, one.made, one.naming, true});
  }
}

UserRequests::Namings::iterator UserRequests::newest(RegionId region, const std::string& name) {
  const auto found = std::find_if(namings_.rbegin(), namings_.rend(), [&](const Naming& naming) {
    return naming.region == region && naming.name == name;
  });
  return found == namings_.rend() ? namings_.end() : std::next(found).base();
}

void UserRequests::undoName(RegionId region, const std::string& name) {
  const Result<std::string> checked = checkedLabelName(name);
  if (!checked) return;
  if (const auto naming = newest(region, *checked); naming != namings_.end()) return undo(naming);
  const auto other = state_.not_objects.find(region);
  if (other == state_.not_objects.end()) return;
  // The object of that name is not added yet.
  tracks_.bind({region}, other->second);
  state_.not_objects.erase(other);
}

void UserRequests::undoObject(RegionId region) {
  if (const auto naming = newest(region, {}); naming != namings_.end()) undo(naming);
}

void UserRequests::undo(Namings::iterator naming) {
  if (!naming->name.empty())
    writer_.revertNaming(naming->number, naming->is_of_earlier_scan ? naming->stored : std::nullopt);
  undone_.push_back(*naming);
  if (const ObjectId made = naming->made) {
    // Frames may find the region again as a new object.
    writer_.withdraw(made);
    state_.requested.erase(made);
    tracks_.forget(made);
    catalogue_.withdraw(made);
  }
  if (naming->earlier) tracks_.bind({naming->region}, naming->earlier);
  namings_.erase(naming);
}

void UserRequests::complete(const Candidate& candidate, ObjectId object, MadeFor made) {
  for (const RegionId region : candidate.regions) {
    const auto found = state_.pending.find(region);
    if (found == state_.pending.end()) continue;
    const GivenName given = found->second;
    const std::string& name = given.name;
    if (!name.empty() && candidate.regions.size() > 1) continue;  // until the region is seen alone
    state_.pending.erase(found);
    state_.requested.insert(object);
    const auto other = state_.not_objects.find(region);
    const ObjectId earlier = other == state_.not_objects.end() ? ObjectId{} : other->second;
    state_.not_objects.erase(region);
    const ObjectId made_for_it = made == MadeFor::request ? object : ObjectId{};
    if (name.empty() && !made_for_it) continue;
    namings_.push_back({++last_naming_, region, name, earlier, made_for_it});
    if (name.empty()) continue;
    const GivenName valid = withValidClass(given);
    catalogue_.name(object, valid);
    writer_.name(last_naming_, object, valid);
  }
}

bool UserRequests::isEdited(ObjectId object) const {
  const ObjectRecord* record = catalogue_.currentRecord(object);
  return record == nullptr || isSettled(*record) || isRequested(object) ||
         catalogue_.isMergeEdited(record->id);
}

bool UserRequests::isFixed(ObjectId object) const {
  return isEdited(object) || !CatalogueMirror::isOfThisScan(catalogue_.mergeRootOf(object));
}

bool UserRequests::isFixed(RegionId region) const {
  const ObjectId object = tracks_.objectOf(region);
  return object && isFixed(object);
}

}  // namespace scantrove
