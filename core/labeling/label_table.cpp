#include "core/labeling/label_table.h"

#include "core/base/check.h"

namespace scantrove {

RegionId LabelTable::newLabel() {
  const auto label = static_cast<std::uint32_t>(parents_.size());
  parents_.push_back(label);
  flat_.push_back(label);
  return RegionId{label};
}

std::uint32_t LabelTable::find(std::uint32_t label) const {
  SCANTROVE_CHECK(label < parents_.size());
  std::uint32_t root = label;
  while (parents_[root] != root) root = parents_[root];
  while (parents_[label] != root) {
    const std::uint32_t next = parents_[label];
    parents_[label] = root;
    label = next;
  }
  return root;
}

RegionId LabelTable::regionOf(std::uint32_t label) const { return RegionId{find(label)}; }

bool LabelTable::join(RegionId into, RegionId from) {
  const std::uint32_t into_root = find(into.value);
  const std::uint32_t from_root = find(from.value);
  if (into_root == from_root || into_root == 0 || from_root == 0) return false;
  parents_[from_root] = into_root;
  flat_is_current_ = false;
  return true;
}

const std::vector<std::uint32_t>& LabelTable::regionOfLabel() const {
  if (!flat_is_current_) {
    for (std::uint32_t label = 0; label < flat_.size(); ++label) flat_[label] = find(label);
    flat_is_current_ = true;
  }
  return flat_;
}

}  // namespace scantrove
