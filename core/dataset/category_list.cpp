#include "core/dataset/category_list.h"

#include <algorithm>
#include <set>

#include "core/dataset/region_choice.h"

namespace scantrove {
namespace {

/// The id after `last`, or else the smallest one that is not among `taken`.
std::uint32_t freeIdAfter(std::uint32_t last, const std::set<std::uint32_t>& taken) {
  if (last < kLargestClassId) return last + 1;
  std::uint32_t id = 1;
  while (taken.contains(id)) ++id;
  return id;
}

}  // namespace

CategoryList::CategoryList(const std::vector<ObjectClass>& classes,
                           const std::vector<LabeledRegion>& regions) {
  std::map<std::uint32_t, DatasetCategory> categories;
  std::set<std::uint32_t> taken;
  std::map<std::string, std::uint32_t> ids;  // by name
  const auto add = [&](const DatasetCategory& category) {
    taken.insert(category.id);
    categories.try_emplace(category.id, category);
    ids.try_emplace(category.name, category.id);
  };
  const auto unlisted = [](std::uint32_t id, const std::string& name) {
    return DatasetCategory{id, name, "", defaultClassColor(ClassId{id})};
  };
  for (const ObjectClass& one : classes) {
    if (!one.hidden) add({one.id.value, validUtf8(one.name), validUtf8(one.supercategory), one.color});
    taken.insert(one.id.value);
  }
  for (const LabeledRegion& region : regions) {
    if (region.class_id) add(unlisted(region.class_id.value, classOf(region)));
  }
  std::set<std::string> others;
  for (const LabeledRegion& region : regions) {
    if (!region.class_id && !ids.contains(classOf(region))) others.insert(classOf(region));
  }
  std::uint32_t last = taken.empty() ? 0 : *taken.rbegin();
  for (const std::string& name : others) {
    add(unlisted(freeIdAfter(last, taken), name));
    last = *taken.rbegin();
  }
  for (const auto& [id, category] : categories) {
    by_id_[id] = categories_.size();
    categories_.push_back(category);
  }
  for (const auto& [name, id] : ids) by_name_[name] = by_id_.at(id);
}

std::size_t CategoryList::indexOf(const LabeledRegion& region) const {
  return indexOf(region.class_id, classOf(region));
}

std::size_t CategoryList::indexOf(ClassId id, const std::string& name) const {
  return id ? by_id_.at(id.value) : by_name_.at(name);
}

}  // namespace scantrove
