#include "core/labeling/label_cloud.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "core/compute/kernel_types.h"
#include "core/labeling/fit_buffer.h"
#include "core/labeling/kernels/label_voxel.h"
#include "embedded/labeling_kernels.h"

namespace scantrove {
namespace {
/// Pixels that only confirm voxels of full confidence write in one of kTurns updates, in runs of kTurnPixels.
constexpr std::size_t kTurns = 4, kTurnPixels = 16;
}  // namespace

LabelCloud::LabelCloud(ComputeContext& compute, PointExtractor extractor)
    : compute_(compute), extractor_(std::move(extractor)), touched_count_(compute.context(), 1) {}

Result<std::unique_ptr<LabelCloud>> LabelCloud::create(ComputeContext& compute) {
  Result<PointExtractor> extractor = PointExtractor::create(compute);
  if (!extractor) return fail(extractor.error());
  std::unique_ptr<LabelCloud> cloud(new LabelCloud(compute, std::move(*extractor)));
  SCANTROVE_TRY(cloud->buildKernels());
  return cloud;
}

Result<void> LabelCloud::buildKernels() {
  SCANTROVE_TRY(moveInto(project_labels_, compute_.kernel(kernels::labeling, "project_labels")));
  SCANTROVE_TRY(moveInto(update_labels_, compute_.kernel(kernels::labeling, "update_labels")));
  return moveInto(relabel_voxels_, compute_.kernel(kernels::labeling, "relabel_voxels"));
}

std::vector<FragmentId> LabelCloud::project(const SurfaceMaps& surface, const BrickMap& bricks) {
  const int pixels = surface.K.pixels();
  fitBuffer(compute_.context(), projected_, static_cast<std::size_t>(pixels));
  fitStamps(bricks);
  const Lanes& lanes = compute_.lanes();
  project_labels_.launch(lanes.inTurn(static_cast<std::size_t>(pixels)), lanes.inTurnGroup(),
                         surface.vertices_world, cl_int{pixels}, surface.window.cells(),
                         bricks.device().pageSlots(), surface.window.size(), surface.window.first(),
                         bricks.pools().labels(), stamps_, 1.0F / bricks.voxelSize(), projected_);
  projected_host_.resize(static_cast<std::size_t>(pixels));
  projected_.read(compute_.queue(), std::span<cl_uint>(projected_host_));
  projected_view_ = surface.T_world_camera;
  std::vector<FragmentId> result(projected_host_.size());
  std::ranges::transform(projected_host_, result.begin(),
                         [](cl_uint label) { return FragmentId{label & LABEL_MAX}; });
  return result;
}

void LabelCloud::fitFragments(std::uint32_t highest) {
  const std::size_t needed = std::size_t{highest} + 1;
  if (fragment_voxels_.size() < needed) {
    Buffer<cl_int> larger(compute_.context(), needed + needed / 2);
    larger.fill(compute_.queue(), 0);
    larger.write(compute_.queue(), fragment_voxels_host_);
    fragment_voxels_ = larger;
  }
  if (fragment_voxels_host_.size() < needed) fragment_voxels_host_.resize(needed, 0);
}

std::span<const Eigen::Vector3i> LabelCloud::update(const SurfaceMaps& surface,
                                                    std::span<const FragmentId> merged,
                                                    std::span<const FragmentId> split_off,
                                                    const LabelingParams& params, const BrickMap& map) {
  const bool is_projected = projected_view_ && projected_view_->matrix() == surface.T_world_camera.matrix();
  listPixels(merged, split_off, !params.voxel_confidence || !is_projected);
  touched_bricks_.clear();
  writeLabels(surface, params, map);
  fragment_voxels_.read(compute_.queue(), std::span<cl_int>(fragment_voxels_host_));
  return touched_bricks_;
}

void LabelCloud::listPixels(std::span<const FragmentId> merged, std::span<const FragmentId> split_off,
                            bool all) {
  if (!all) ++turn_;
  pixels_host_.clear();
  new_labels_host_.clear();
  std::uint32_t highest = 0;
  for (std::size_t pixel = 0; pixel < merged.size(); ++pixel) {
    const std::uint32_t fragment = merged[pixel].value;
    const bool has_turn = all || (pixel / kTurnPixels + turn_) % kTurns == 0;
    if (fragment == 0 || (!has_turn && projected_host_[pixel] == (fragment | LABEL_SURE))) continue;
    highest = std::max(highest, fragment);
    const bool at_once = std::ranges::find(split_off, FragmentId{fragment}) != split_off.end();
    pixels_host_.push_back(static_cast<cl_int>(pixel));
    new_labels_host_.push_back(fragment | (at_once ? LABEL_AT_ONCE : 0U));
  }
  fitFragments(highest);
  fitBuffer(compute_.context(), pixels_, pixels_host_.size());
  fitBuffer(compute_.context(), new_labels_, new_labels_host_.size());
  pixels_.write(compute_.queue(), pixels_host_);
  new_labels_.write(compute_.queue(), new_labels_host_);
}

void LabelCloud::writeLabels(const SurfaceMaps& surface, const LabelingParams& params, const BrickMap& map) {
  if (pixels_host_.empty()) return;
  fitStamps(map);
  touched_count_.fill(compute_.queue(), 0);
  ++stamp_;
  const Intrinsics& K = surface.K;
  const Lanes& lanes = compute_.lanes();
  update_labels_.launch(lanes.inTurn(pixels_host_.size()), lanes.inTurnGroup(), surface.vertices_world,
                        pixels_, new_labels_, static_cast<cl_int>(pixels_host_.size()),
                        surface.window.cells(), map.device().pageSlots(), surface.window.size(),
                        surface.window.first(), map.device().table(), map.device().tableMask(),
                        toKernel(surface.T_world_camera.inverse()), toKernel(K.fx, K.fy, K.cx, K.cy),
                        cl_int{K.width}, map.voxelSize(), params.update_distance_vox * map.voxelSize(),
                        params.reach_of_depth, cl_int{params.voxel_confidence ? 1 : 0}, cl_int{stamp_},
                        map.pools().labels(), fragment_voxels_, stamps_, touched_count_, touched_);
  cl_int touched = 0;
  touched_count_.read(compute_.queue(), std::span<cl_int>(&touched, 1));
  touched_slots_.resize(static_cast<std::size_t>(touched));
  touched_.read(compute_.queue(), std::span<cl_int>(touched_slots_));
  // Slots may be reassigned before the caller reads them, so store positions.
  for (const cl_int slot : touched_slots_) touched_bricks_.push_back(map.device().positionOf(slot));
}

void LabelCloud::fitStamps(const BrickMap& map) {
  const auto slots = static_cast<std::size_t>(std::max(1, map.device().slotEnd()));
  if (stamps_.size() >= slots) return;
  fitBuffer(compute_.context(), stamps_, slots);
  fitBuffer(compute_.context(), touched_, slots);
  stamps_.fill(compute_.queue(), LABEL_BRICK_UNUSED);
}

void LabelCloud::relabel(std::span<const Eigen::Vector3i> voxels, FragmentId fragment, BrickMap& map) {
  if (voxels.empty()) return;
  std::vector<cl_int4> listed;
  std::set<int> pages;
  for (const Eigen::Vector3i& v : voxels) {
    listed.push_back({{v.x(), v.y(), v.z(), 0}});
    const int page = map.pages().pageWith({v.x() >> BRICK_SHIFT, v.y() >> BRICK_SHIFT, v.z() >> BRICK_SHIFT});
    if (page != BRICK_NONE) pages.insert(page);
  }
  map.beginFrame(std::vector<int>(pages.begin(), pages.end()));
  fitFragments(fragment.value);
  fitBuffer(compute_.context(), listed_, listed.size());
  listed_.write(compute_.queue(), listed);
  relabel_voxels_.launch(cl::NDRange(listed.size()), cl::NDRange(64), listed_,
                         static_cast<cl_int>(listed.size()), fragment.value, map.device().table(),
                         map.device().tableMask(), map.pools().labels(), fragment_voxels_);
  fragment_voxels_.read(compute_.queue(), std::span<cl_int>(fragment_voxels_host_));
}

void LabelCloud::restoreVoxelCounts(std::vector<cl_int> voxels) {
  fitFragments(voxels.empty() ? 0 : static_cast<std::uint32_t>(voxels.size() - 1));
  std::ranges::copy(voxels, fragment_voxels_host_.begin());
  fragment_voxels_.write(compute_.queue(), fragment_voxels_host_);
}

}  // namespace scantrove
