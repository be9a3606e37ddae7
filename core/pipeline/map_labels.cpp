#include "core/pipeline/map_labels.h"

#include <limits>
#include <utility>

namespace scantrove {

MapLabels::MapLabels(BrickMap& bricks, std::unique_ptr<LabelCloud> cloud, const Setup& setup)
    : bricks_(bricks),
      cloud_(std::move(cloud)),
      estimated_(bricks.voxelSize()),
      merger_(makeRegionMerger(setup.rule)),
      editable_(*cloud_, bricks, setup.truncation_vox) {
  editor_.emplace(table_, *merger_, editable_);
}

Result<std::unique_ptr<MapLabels>> MapLabels::create(ComputeContext& compute, BrickMap& bricks,
                                                     const Setup& setup) {
  std::unique_ptr<LabelCloud> cloud;
  SCANTROVE_TRY(moveInto(cloud, LabelCloud::create(compute)));
  return std::unique_ptr<MapLabels>(new MapLabels(bricks, std::move(cloud), setup));
}

RegionMerger::Outcome MapLabels::merge(const SegmentMap& segments, const RenderedView& view,
                                       std::span<const Eigen::Vector3f> color_lab,
                                       std::span<const std::uint8_t> newly_appeared,
                                       const LabelingParams& params) {
  const std::vector<int> voxels = sizesOfFragments();
  return merger_->merge({segments, view, color_lab, voxels, newly_appeared}, table_, params);
}

std::span<const Eigen::Vector3i> MapLabels::update(const SurfaceMaps& surface,
                                                   const RegionMerger::Outcome& merged,
                                                   const LabelingParams& params) {
  for (std::size_t i = 0; i < merged.split_off.size(); ++i)
    editor_->splitOff(merged.split_off[i], merged.split_from[i]);
  const std::span<const Eigen::Vector3i> touched =
      cloud_->update(surface, merged.fragments, merged.split_off, params, bricks_);
  forgetFragments();
  return touched;
}

void MapLabels::forgetFragments() {
  const std::vector<int> voxels = sizesOfFragments();
  for (std::uint32_t fragment = 1; fragment < table_.regions().size(); ++fragment) {
    if (!table_.regions()[fragment] || (fragment < voxels.size() && voxels[fragment] > 0)) continue;
    merger_->forget(FragmentId{fragment});
    editor_->forget(FragmentId{fragment});
    table_.free(FragmentId{fragment});
  }
}

std::vector<int> MapLabels::sizesOfFragments() const {
  std::vector<int> sizes = cloud_->voxelsOfFragments();
  const std::vector<int>& cells = estimated_.cellsOfFragments();
  if (sizes.size() < cells.size()) sizes.resize(cells.size(), 0);
  for (std::size_t fragment = 0; fragment < cells.size(); ++fragment) sizes[fragment] += cells[fragment];
  return sizes;
}

float MapLabels::joiningOdds(RegionId a, RegionId b, const RegionTable& table,
                             const LabelingParams& params) const {
  constexpr float kNever = -std::numeric_limits<float>::infinity();
  return merger_->joiningOdds(a, b, table, cloud_->voxelsOfFragments(), params).value_or(kNever);
}

void MapLabels::setKnown(const RegionSet& regions, Known known) {
  for (const RegionId region : regions) {
    table_.setKnown(region, known != Known::no);
    if (known == Known::one_object) merger_->mustBeOne(*regions.begin(), region, table_);
  }
}

void MapLabels::setRule(LabelingParams::Rule rule) {
  merger_ = makeRegionMerger(rule);
  editor_->useMerger(*merger_);
}

}  // namespace scantrove
