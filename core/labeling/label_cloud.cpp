#include "core/labeling/label_cloud.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/compute/kernel_types.h"
#include "embedded/labeling_kernels.h"

namespace scantrove {
namespace {
constexpr int kMissingCapacity = 1 << 16;
}  // namespace

LabelCloud::LabelCloud(ComputeContext& compute)
    : compute_(compute), count_(compute.context(), 1), missing_(compute.context(), kMissingCapacity) {}

Result<std::unique_ptr<LabelCloud>> LabelCloud::create(ComputeContext& compute) {
  std::unique_ptr<LabelCloud> cloud(new LabelCloud(compute));
  SCANTROVE_TRY(cloud->buildKernels());
  return cloud;
}

Result<void> LabelCloud::buildKernels() {
  SCANTROVE_TRY(moveInto(project_labels_, compute_.kernel(kernels::project_labels, "project_labels")));
  SCANTROVE_TRY(moveInto(list_uncovered_bricks_,
                         compute_.kernel(kernels::list_uncovered_bricks, "list_uncovered_bricks")));
  SCANTROVE_TRY(moveInto(update_labels_, compute_.kernel(kernels::update_labels, "update_labels")));
  return moveInto(extract_points_, compute_.kernel(kernels::extract_points, "extract_points"));
}

std::vector<FragmentId> LabelCloud::project(const SurfaceMaps& surface, const BrickMap& bricks) {
  fitPools(bricks);
  const int pixels = surface.K.pixels();
  fit(projected_, static_cast<std::size_t>(pixels));
  project_labels_.launch(cl::NDRange(static_cast<std::size_t>(pixels)), cl::NDRange(64),
                         surface.vertices_world, cl_int{pixels}, bricks.table(), bricks.tableMask(), labels_,
                         1.0F / bricks.voxelSize(), projected_);
  std::vector<FragmentId> result(static_cast<std::size_t>(pixels));
  static_assert(sizeof(FragmentId) == sizeof(cl_uint));
  projected_.read(compute_.queue(), {reinterpret_cast<cl_uint*>(result.data()), result.size()});
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

std::span<const cl_int> LabelCloud::update(const SurfaceMaps& surface, const RegionMap& merged,
                                           std::span<const FragmentId> carved, const LabelingParams& params,
                                           BrickMap& bricks) {
  const float reach = params.update_distance_vox * bricks.voxelSize();
  makeMissingBricks(surface, reach, bricks);
  fitPools(bricks);
  new_labels_host_.resize(merged.fragments.size());
  std::uint32_t highest = 0;
  std::ranges::transform(merged.fragments, new_labels_host_.begin(), [&](FragmentId fragment) {
    highest = std::max(highest, fragment.value);
    const bool at_once = std::ranges::find(carved, fragment) != carved.end();
    return fragment.value | (at_once ? LABEL_AT_ONCE : 0U);
  });
  fitFragments(highest);
  fit(new_labels_, new_labels_host_.size());
  new_labels_.write(compute_.queue(), new_labels_host_);
  count_.fill(compute_.queue(), 0);
  ++stamp_;
  const Intrinsics& K = surface.K;
  update_labels_.launch(cl::NDRange(static_cast<std::size_t>(K.pixels())), cl::NDRange(64),
                        surface.vertices_world, new_labels_, bricks.table(), bricks.tableMask(),
                        toKernel(surface.T_world_camera.inverse()), toKernel(K.fx, K.fy, K.cx, K.cy),
                        cl_int{K.width}, cl_int{K.height}, bricks.voxelSize(), reach,
                        static_cast<cl_int>(params.voxel_confidence ? 1 : 0), cl_int{stamp_}, labels_,
                        fragment_voxels_, stamps_, count_, touched_);
  cl_int count = 0;
  count_.read(compute_.queue(), std::span<cl_int>(&count, 1));
  touched_host_.resize(static_cast<std::size_t>(count));
  touched_.read(compute_.queue(), std::span<cl_int>(touched_host_));
  fragment_voxels_.read(compute_.queue(), std::span<cl_int>(fragment_voxels_host_));
  return touched_host_;
}

LabelCloud::Extract LabelCloud::extract(std::span<const cl_int> slots, const BrickMap& bricks,
                                        float truncation_vox) {
  // Bricks that no update has reached have no labels; that may be so for good when memory ran out.
  std::vector<cl_int> labelled;
  std::ranges::copy_if(slots, std::back_inserter(labelled),
                       [this](cl_int slot) { return slot < positions_known_; });
  Extract result;
  if (labelled.empty()) {
    result.first.assign(slots.size() + 1, 0);
    return result;
  }
  fit(listed_, labelled.size());
  fit(offsets_, labelled.size());
  fit(points_, 1);
  listed_.write(compute_.queue(), labelled);
  const auto run = [&](int write) {
    const auto band = static_cast<cl_int>(32767.0F / truncation_vox);
    extract_points_.launch(cl::NDRange(labelled.size()), cl::NDRange(8), listed_,
                           static_cast<cl_int>(labelled.size()), positions_, bricks.voxels(), labels_,
                           bricks.voxelSize(), band, cl_int{write}, offsets_, points_);
  };
  run(0);
  std::vector<cl_int> offsets(labelled.size());
  offsets_.read(compute_.queue(), std::span<cl_int>(offsets));
  cl_int total = 0;
  for (cl_int& entry : offsets) total += std::exchange(entry, total);
  auto next = offsets.begin();
  for (const cl_int slot : slots) {
    result.first.push_back(static_cast<std::uint32_t>(next == offsets.end() ? total : *next));
    if (slot < positions_known_) ++next;
  }
  result.first.push_back(static_cast<std::uint32_t>(total));
  result.points.resize(static_cast<std::size_t>(total));
  if (total == 0) return result;
  fit(points_, result.points.size());
  offsets_.write(compute_.queue(), offsets);
  run(1);
  points_.read(compute_.queue(), std::span<LabelPoint>(result.points));
  return result;
}

void LabelCloud::fitPools(const BrickMap& bricks) {
  const auto capacity = static_cast<std::size_t>(bricks.slotCapacity());
  if (stamps_.size() < capacity) {
    Buffer<cl_uint> labels(compute_.context(), capacity * BRICK_VOXELS);
    if (labels_.size() > 0) {
      compute_.queue().enqueueCopyBuffer(labels_.cl(), labels.cl(), 0, 0, labels_.size() * sizeof(cl_uint));
    }
    labels.fill(compute_.queue(), 0U, labels_.size(), labels.size() - labels_.size());
    labels_ = labels;
    stamps_ = Buffer<cl_int>(compute_.context(), capacity);
    stamps_.fill(compute_.queue(), -1);
    touched_ = Buffer<cl_int>(compute_.context(), capacity);
    positions_ = Buffer<cl_int4>(compute_.context(), capacity);
    positions_known_ = 0;
  }
  std::vector<cl_int4> fresh;
  for (int slot = positions_known_; slot < bricks.brickCount(); ++slot) {
    const Eigen::Vector3i& position = bricks.positionOf(slot);
    fresh.push_back({{position.x(), position.y(), position.z(), 0}});
  }
  positions_.write(compute_.queue(), fresh, static_cast<std::size_t>(positions_known_));
  positions_known_ = bricks.brickCount();
}

void LabelCloud::makeMissingBricks(const SurfaceMaps& surface, float reach, BrickMap& bricks) {
  const int pixels = surface.K.pixels();
  for (;;) {
    count_.fill(compute_.queue(), 0);
    list_uncovered_bricks_.launch(cl::NDRange(static_cast<std::size_t>(pixels)), cl::NDRange(64),
                                  surface.vertices_world, cl_int{pixels}, bricks.table(), bricks.tableMask(),
                                  reach, 1.0F / (bricks.voxelSize() * BRICK_SIDE), count_, missing_,
                                  cl_int{kMissingCapacity});
    cl_int count = 0;
    count_.read(compute_.queue(), std::span<cl_int>(&count, 1));
    if (count == 0) return;
    std::vector<cl_int4> missing(static_cast<std::size_t>(std::min(count, cl_int{kMissingCapacity})));
    missing_.read(compute_.queue(), std::span<cl_int4>(missing));
    std::vector<Eigen::Vector3i> wanted;
    for (const cl_int4& m : missing) wanted.emplace_back(m.s[0], m.s[1], m.s[2]);
    sortBricks(wanted);
    bricks.allocate(wanted);
  }
}

}  // namespace scantrove
