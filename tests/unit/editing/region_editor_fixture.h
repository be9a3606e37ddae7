#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "core/editing/region_editor.h"
#include "core/labeling/graph_merger.h"
#include "core/labeling/region_partition.h"

namespace scantrove::test {

/// A flat strip of voxels at z = 0.
class StripMap final : public EditableMap {
 public:
  void setRange(FragmentId fragment, int from, int to) {
    for (int x = from; x < to; ++x) {
      for (int y = 0; y < 10; ++y) set(x, y, fragment);
    }
  }
  float voxelSize() const override { return 0.01F; }
  std::span<const int> voxelsOfFragments() const override { return counts_; }
  std::vector<SurfaceVoxel> surfaceOf(std::span<const FragmentId> fragments,
                                      std::span<const Eigen::Vector3f> places) override {
    std::vector<SurfaceVoxel> voxels;
    for (const auto& [position, fragment] : labels_) {
      if (!places.empty() && out_of_reach_ && position.first >= *out_of_reach_) continue;
      if (std::ranges::find(fragments, fragment) != fragments.end())
        voxels.push_back(
            {{position.first, position.second, 0}, {0, 0, 1}, fragment, colorAt(position.first)});
    }
    return voxels;
  }
  void relabel(std::span<const Eigen::Vector3i> voxels, FragmentId fragment) override {
    for (const Eigen::Vector3i& voxel : voxels) set(voxel.x(), voxel.y(), fragment);
  }
  FragmentId at(int x) const { return labels_.at({x, 5}); }
  /// Colours the strip green from `from` to `to` and brown elsewhere; without, it has no colours.
  void color(int from, int to) { green_ = {from, to}; }
  /// No place before column `from` is connected with it and those after it.
  void disconnect(int from) { out_of_reach_ = from; }

 private:
  void set(int x, int y, FragmentId fragment) {
    FragmentId& label = labels_[{x, y}];
    counts_.resize(std::max<std::size_t>(counts_.size(), fragment.value + std::size_t{1}), 0);
    if (label) --counts_[label.value];
    ++counts_[fragment.value];
    label = fragment;
  }
  std::optional<std::array<std::uint8_t, 3>> colorAt(int x) const {
    if (!green_) return std::nullopt;
    const bool is_green = x >= green_->first && x < green_->second;
    return is_green ? std::array<std::uint8_t, 3>{80, 160, 90} : std::array<std::uint8_t, 3>{190, 150, 100};
  }
  std::optional<std::pair<int, int>> green_;
  std::optional<int> out_of_reach_;
  std::map<std::pair<int, int>, FragmentId> labels_;
  std::vector<int> counts_{0};
};

/// Four fragments in a row, each a region of its own: 0 - 20, 20 - 40, 40 - 60, 60 - 80.
class RegionEditorTest : public testing::Test {
 protected:
  RegionEditorTest() {
    for (int i = 0; i < 4; ++i) {
      fragments_.push_back(table_.newFragment());
      map_.setRange(fragments_.back(), 20 * i, 20 * (i + 1));
    }
  }
  RegionId regionAt(int x) const { return table_.regionOf(map_.at(x)); }
  Result<RegionEditor::Outcome> apply(Operation operation) { return editor_.apply(operation, params_); }
  /// Updates the regions as each frame does after an operation.
  void partition() {
    RegionEvents events;
    updatePartition(fragments_, merger_.graph(), map_.voxelsOfFragments(), params_, table_, events);
  }
  /// Adds evidence of 20 frames that `a` and `b` are one object or two.
  void addEvidence(FragmentId a, FragmentId b, bool is_one) {
    FragmentContact contact;
    contact.a = a;
    contact.b = b;
    contact.length_px = 100;
    contact.bridged_px = is_one ? 100 : 0;
    contact.length_m = 0.3F;
    contact.depth_m = 1;
    contact.bends = 80;
    contact.concavity_rad = is_one ? 0.F : 0.9F;
    contact.color_shift = is_one ? 1.F : 40.F;
    contact.colors = {*contact.color_shift, *contact.color_shift};
    contact.folded = is_one ? 0.F : 1.F;
    auto& graph = const_cast<EvidenceGraph&>(merger_.graph());
    for (int frame = 0; frame < 20; ++frame) graph.between(a, b).add(contact, is_one ? 1 : 0);
  }
  /// Adds a fragment to a region, as frames do: 20 voxels wide from `from` on.
  FragmentId grow(RegionId region, int from) {
    const FragmentId fragment = table_.newFragment();
    map_.setRange(fragment, from, from + 20);
    table_.join(region, table_.regionOf(fragment));
    return fragment;
  }
  std::vector<RegionId> all() const {
    std::vector<RegionId> regions;
    for (int x = 10; x < 80; x += 20) regions.push_back(regionAt(x));
    return regions;
  }

  RegionTable table_;
  GraphMerger merger_;
  StripMap map_;
  LabelingParams params_;
  RegionEditor editor_{table_, merger_, map_};
  std::vector<FragmentId> fragments_;
};

}  // namespace scantrove::test
