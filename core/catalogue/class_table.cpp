#include "core/catalogue/class_table.h"

#include <algorithm>
#include <set>
#include <utility>

namespace scantrove {

void ClassTable::put(ObjectClass object_class) {
  if (const ObjectClass* before = find(object_class.id)) {
    const auto known = ids_.find(before->name);
    if (known != ids_.end() && known->second == before->id) ids_.erase(known);
  }
  if (!object_class.hidden) ids_[object_class.name] = object_class.id;
  const ClassId id = object_class.id;
  classes_[id] = std::move(object_class);
}

std::vector<ObjectClass> ClassTable::visible() const {
  std::vector<ObjectClass> list;
  for (const auto& [id, one] : classes_) {
    if (!one.hidden) list.push_back(one);
  }
  return list;
}

const ObjectClass* ClassTable::find(ClassId id) const {
  const auto found = classes_.find(id);
  return found == classes_.end() ? nullptr : &found->second;
}

const ObjectClass* ClassTable::named(std::string_view name) const {
  const auto found = ids_.find(name);
  return found == ids_.end() ? nullptr : find(found->second);
}

const ObjectClass* ClassTable::hiddenNamed(std::string_view name) const {
  const auto found = std::ranges::find_if(classes_, [&](const auto& entry) {
    return entry.second.hidden && !entry.second.merged_into && entry.second.name == name;
  });
  return found == classes_.end() ? nullptr : &found->second;
}

const ObjectClass* ClassTable::rootOf(ClassId id) const {
  const ObjectClass* root = find(id);
  std::set<ClassId> passed;
  while (root != nullptr && root->hidden && root->merged_into && passed.insert(root->id).second) {
    const ObjectClass* next = find(root->merged_into);
    if (next == nullptr) break;
    root = next;
  }
  return root;
}

std::vector<ClassId> ClassTable::familyOf(ClassId root) const {
  std::vector<ClassId> family;
  for (const auto& [id, one] : classes_) {
    if (const ObjectClass* of_it = rootOf(id); of_it != nullptr && of_it->id == root) family.push_back(id);
  }
  return family;
}

std::vector<ClassAttribute> ClassTable::attributesOf(ClassId root) const {
  std::vector<ClassId> family = familyOf(root);
  std::stable_partition(family.begin(), family.end(), [root](ClassId id) { return id == root; });
  std::vector<ClassAttribute> all;
  for (const ClassId id : family) {
    for (const ClassAttribute& attribute : classes_.at(id).attributes) {
      if (std::ranges::find(all, attribute.name, &ClassAttribute::name) == all.end())
        all.push_back(attribute);
    }
  }
  return all;
}

ClassId ClassTable::nextId() const {
  if (classes_.empty()) return ClassId{1};
  const std::uint32_t largest = classes_.rbegin()->first.value;
  if (largest < kLargestClassId) return ClassId{largest + 1};
  std::uint32_t free = 1;
  for (const auto& [id, one] : classes_) {
    if (id.value != free) break;
    ++free;
  }
  return ClassId{free};
}

const ObjectClass* ClassTable::suggestedBy(std::string_view name) const {
  if (const ObjectClass* known = named(name)) return known;
  std::string_view end = withoutNumber(name);
  for (;;) {
    if (const ObjectClass* known = named(end)) return known;
    const std::size_t blank = end.find(' ');
    if (blank == std::string_view::npos) return nullptr;
    end.remove_prefix(blank + 1);
  }
}

std::string_view withoutNumber(std::string_view name) {
  const std::size_t digits = name.find_last_not_of("0123456789");
  if (digits == std::string_view::npos || digits + 1 == name.size() || name[digits] != ' ') return name;
  const std::size_t end = name.find_last_not_of(' ', digits);
  return end == std::string_view::npos ? name : name.substr(0, end + 1);
}

}  // namespace scantrove
