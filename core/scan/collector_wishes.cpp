// What ObjectCollector does because a person said something of a region.
#include <algorithm>

#include "core/scan/object_collector.h"

namespace scantrove {

ObjectId ObjectCollector::boundTo(RegionId region) const {
  const ObjectId object = met_.objectOf(region);
  return object && recordOf(catalogue_.mergeRootOf(object)) != nullptr ? object : ObjectId{};
}

bool ObjectCollector::areOneObject(const RegionSet& regions) const {
  const ObjectId first = catalogue_.mergeRootOf(boundTo(*regions.begin()));
  return first && std::ranges::all_of(regions, [&](RegionId region) {
           return catalogue_.mergeRootOf(boundTo(region)) == first;
         });
}

void ObjectCollector::want(RegionId region, const std::string& name) {
  if (boundTo(region)) return wantNoMore(region);
  met_.bind({region}, {});
  const Result<std::string> checked = ObjectDatabase::checkedName(name);
  wanted_[region] = checked ? *checked : std::string();
}

void ObjectCollector::wantNoMore(RegionId region) { wanted_.erase(region); }

void ObjectCollector::followWanted(RegionId into, RegionId from) {
  const auto found = wanted_.find(from);
  if (found == wanted_.end()) return;
  wanted_.try_emplace(into, found->second);
  wanted_.erase(found);
}

bool ObjectCollector::isWanted(const RegionSet& regions) const {
  return std::ranges::any_of(wanted_, [&](const auto& requested) {
    // A name is that of the region alone.
    return regions.contains(requested.first) && (requested.second.empty() || regions.size() == 1);
  });
}

const std::string* ObjectCollector::wantedName(const Candidate& candidate) const {
  if (candidate.regions.size() != 1) return nullptr;
  const auto found = wanted_.find(*candidate.regions.begin());
  return found == wanted_.end() ? nullptr : &found->second;
}

bool ObjectCollector::isCalledOtherwise(RegionId region, const std::string& name) const {
  const ObjectId root = catalogue_.mergeRootOf(boundTo(region));
  std::map<RegionId, std::string> names;  // by now
  for (const Naming& naming : namings_) {
    if (!naming.name.empty()) names[naming.region] = naming.name;
  }
  return std::ranges::any_of(names, [&](const auto& named) {
    return named.first != region && named.second != name &&
           catalogue_.mergeRootOf(boundTo(named.first)) == root;
  });
}

void ObjectCollector::nameByPerson(RegionId region, const std::string& name) {
  nameByPerson(region, name, 0);
}

void ObjectCollector::nameAgain(RegionId region, const std::string& name) {
  const Result<std::string> checked = ObjectDatabase::checkedName(name);
  const auto newest = std::find_if(undone_.rbegin(), undone_.rend(), [&](const Naming& naming) {
    return naming.region == region && checked && naming.name == *checked;
  });
  const int again = newest == undone_.rend() ? 0 : newest->number;
  if (again != 0) undone_.erase(std::next(newest).base());
  nameByPerson(region, name, again);
}

void ObjectCollector::nameByPerson(RegionId region, const std::string& name, int again) {
  const Result<std::string> checked = ObjectDatabase::checkedName(name);
  if (!checked) {
    refusals_.push_back(
        {"The catalogue has no object of the name that the region got. " + checked.error().what,
         checked.error().advice});
    return;
  }
  const ObjectId object = boundTo(region);
  if (!object) return;
  const ObjectRecord* record = recordOf(catalogue_.mergeRootOf(object));
  const ObjectRecord* called_so = catalogue_.named(*checked);
  const bool is_other = called_so != nullptr && called_so->id != record->id;
  if (isCalledOtherwise(region, *checked) || (is_other && isSettled(*record))) {
    // It is another thing than that.
    met_.bind({region}, {});
    not_these_[region] = object;
    return;
  }
  namings_.push_back({++last_naming_, region, *checked, {}, {}});
  catalogue_.name(object, *checked);
  writer_->name(last_naming_, object, *checked, again);
}

void ObjectCollector::nameObject(RegionId region, ObjectId object, const std::string& name, ObjectId earlier,
                                 ObjectId made) {
  namings_.push_back({++last_naming_, region, name, earlier, made});
  catalogue_.name(object, name);
  writer_->name(last_naming_, object, name);
}

bool ObjectCollector::hasNamed(RegionId region, const std::string& name) const {
  const Result<std::string> checked = ObjectDatabase::checkedName(name);
  return checked && std::ranges::any_of(namings_, [&](const Naming& naming) {
           return naming.region == region && naming.name == *checked;
         });
}

void ObjectCollector::noteStored(const news::NameStored& news) {
  const auto found = std::ranges::find(namings_, news.number, &Naming::number);
  if (found != namings_.end()) found->stored = news.naming;
}

std::map<RegionId, std::vector<StoredNaming>> ObjectCollector::storedNamings() const {
  std::map<RegionId, std::vector<StoredNaming>> kept;
  for (const Naming& naming : namings_) {
    // One that was there, and has the name now, is what the region was before.
    const bool was_there = !naming.earlier && !naming.made && !naming.is_of_before;
    const ObjectId earlier = was_there ? met_.objectOf(naming.region) : naming.earlier;
    const ObjectId made = catalogue_.idOf(naming.made);
    std::optional<ObjectNaming> stored = naming.stored;
    if (naming.name.empty() && made) stored = ObjectNaming{made, {}, {}};
    if (stored) kept[naming.region].push_back({*stored, catalogue_.idOf(earlier), made});
  }
  return kept;
}

void ObjectCollector::restoreNamings(RegionId region, const std::vector<StoredNaming>& kept) {
  for (const StoredNaming& one : kept) {
    const bool is_of_catalogue =
        catalogue_.hasHad(one.naming.object) &&
        (!one.naming.merge || std::ranges::all_of(one.naming.merge->from,
                                                  [this](ObjectId from) { return catalogue_.hasHad(from); }));
    if (!is_of_catalogue) continue;
    namings_.push_back({++last_naming_, region, one.naming.name, one.earlier, one.made, one.naming, true});
  }
}

void ObjectCollector::takeNameBack(RegionId region, const std::string& name) {
  const Result<std::string> checked = ObjectDatabase::checkedName(name);
  if (!checked) return;
  const auto newest = std::find_if(namings_.rbegin(), namings_.rend(), [&](const Naming& naming) {
    return naming.region == region && naming.name == *checked;
  });
  if (const auto other = not_these_.find(region); newest == namings_.rend() && other != not_these_.end()) {
    // It has not been added yet.
    met_.bind({region}, other->second);
    not_these_.erase(other);
  }
  if (newest != namings_.rend()) takeBack(std::next(newest).base());
}

void ObjectCollector::takeObjectBack(RegionId region) {
  const auto newest = std::find_if(namings_.rbegin(), namings_.rend(), [&](const Naming& naming) {
    return naming.region == region && naming.name.empty();
  });
  if (newest != namings_.rend()) takeBack(std::next(newest).base());
}

void ObjectCollector::takeBack(std::vector<Naming>::iterator naming) {
  if (!naming->name.empty())
    writer_->takeNameBack(naming->number, naming->is_of_before ? naming->stored : std::nullopt);
  undone_.push_back(*naming);
  if (naming->made) withdraw(naming->made);
  if (naming->earlier) met_.bind({naming->region}, naming->earlier);
  namings_.erase(naming);
}

void ObjectCollector::withdraw(ObjectId made) {
  writer_->withdraw(made);
  by_person_.erase(made);
  // Frames may find it by themselves, as something new.
  met_.forget(made);
  catalogue_.withdraw(made);
}

void ObjectCollector::fulfil(const Candidate& candidate, ObjectId object, MadeFor made) {
  for (const RegionId region : candidate.regions) {
    const auto found = wanted_.find(region);
    if (found == wanted_.end()) continue;
    const std::string name = found->second;
    if (!name.empty() && candidate.regions.size() > 1) continue;  // until it is seen alone
    wanted_.erase(found);
    by_person_.insert(object);
    const auto other = not_these_.find(region);
    const ObjectId earlier = other == not_these_.end() ? ObjectId{} : other->second;
    not_these_.erase(region);
    const ObjectId made_for_it = made == MadeFor::wish ? object : ObjectId{};
    if (!name.empty()) {
      nameObject(region, object, name, earlier, made_for_it);
    } else if (made_for_it) {
      namings_.push_back({++last_naming_, region, {}, earlier, made_for_it});
    }
  }
}

FrameObjects ObjectCollector::addWanted(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
                                        const SurfaceInColor& in_color,
                                        const std::vector<Candidate>& candidates) {
  FrameObjects objects;
  takeNews(objects);
  const Look look{frame, T_world_camera, in_color, objects};
  for (const Candidate& candidate : candidates) {
    if (wantedName(candidate) != nullptr) collectOne(candidate, identityOf(candidate), look);
  }
  return objects;
}

}  // namespace scantrove
