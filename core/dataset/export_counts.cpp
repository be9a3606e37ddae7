#include "core/dataset/export_counts.h"

#include <algorithm>
#include <cstdint>

namespace scantrove {

ClassCount& ExportCounts::countIn(std::vector<ClassCount>& classes, const std::string& class_name) {
  const auto found = std::ranges::lower_bound(classes, class_name, {}, &ClassCount::name);
  if (found != classes.end() && found->name == class_name) return *found;
  return *classes.insert(found, {class_name, 0, 0, 0});
}

SplitCount& ExportCounts::splitCount(DatasetSplit split) {
  std::vector<SplitCount>& splits = summary_.splits;
  const auto found = std::ranges::lower_bound(splits, split, {}, &SplitCount::split);
  if (found != splits.end() && found->split == split) return *found;
  return *splits.insert(found, {split, 0, 0, {}});
}

void ExportCounts::beginImage(std::optional<DatasetSplit> split) {
  in_image_.clear();
  split_ = split;
}

void ExportCounts::endImage() {
  ++summary_.images;
  if (split_) ++splitCount(*split_).images;
}

void ExportCounts::countMask(const std::string& class_name, int pixels) {
  const int images = in_image_.insert(class_name).second ? 1 : 0;
  const auto add = [&](ClassCount& count) {
    count.images += images;
    ++count.instances;
    count.pixels += static_cast<std::uint64_t>(pixels);
  };
  add(countOf(class_name));
  if (split_) add(countIn(splitCount(*split_).classes, class_name));
  ++summary_.annotations;
}

void ExportCounts::countObject(const std::string& class_name, std::optional<DatasetSplit> split) {
  ++countOf(class_name).instances;
  if (split) ++countIn(splitCount(*split).classes, class_name).instances;
  ++summary_.annotations;
}

}  // namespace scantrove
