#include "core/labeling/label_cloud.h"

#include <algorithm>
#include <utility>

#include "core/compute/kernel_types.h"
#include "embedded/labeling_kernels.h"

namespace scantrove {
namespace {
constexpr int kMissingCapacity = 1 << 16;

struct LabelingKernels {
  Kernel project, list_missing, update, extract;
};

Result<LabelingKernels> buildKernels(ComputeContext& compute) {
  LabelingKernels built;
  SCANTROVE_TRY(moveInto(built.project, compute.kernel(kernels::project_labels, "project_labels")));
  SCANTROVE_TRY(
      moveInto(built.list_missing, compute.kernel(kernels::list_uncovered_bricks, "list_uncovered_bricks")));
  SCANTROVE_TRY(moveInto(built.update, compute.kernel(kernels::update_labels, "update_labels")));
  SCANTROVE_TRY(moveInto(built.extract, compute.kernel(kernels::extract_points, "extract_points")));
  return built;
}
}  // namespace

class LabelCloud::Machinery {
 public:
  Machinery(ComputeContext& compute, LabelingKernels built)
      : compute_(compute),
        kernels_(std::move(built)),
        count_(compute.context(), 1),
        missing_(compute.context(), kMissingCapacity) {}

  std::vector<std::uint32_t> project(const SurfaceMaps& surface, const BrickMap& bricks) {
    fitPools(bricks);
    const int pixels = surface.K.pixels();
    fit(projected_, static_cast<std::size_t>(pixels));
    kernels_.project.launch(cl::NDRange(static_cast<std::size_t>(pixels)), cl::NDRange(64),
                            surface.vertices_world, cl_int{pixels}, bricks.table(), bricks.tableMask(),
                            labels_, 1.0F / bricks.voxelSize(), projected_);
    std::vector<std::uint32_t> result(static_cast<std::size_t>(pixels));
    projected_.read(compute_.queue(), result);
    return result;
  }

  std::span<const cl_int> update(const SurfaceMaps& surface, const RegionMap& merged, const LabelTable& table,
                                 const LabelingParams& params, BrickMap& bricks) {
    const float reach = params.update_distance_vox * bricks.voxelSize();
    makeMissingBricks(surface, reach, bricks);
    fitPools(bricks);
    fit(new_labels_, merged.labels.size());
    new_labels_.write(compute_.queue(), merged.labels);
    const auto& regions = table.regionOfLabel();
    fit(region_of_label_, regions.size());
    region_of_label_.write(compute_.queue(), regions);
    count_.fill(compute_.queue(), 0);
    ++stamp_;
    const Intrinsics& K = surface.K;
    kernels_.update.launch(cl::NDRange(static_cast<std::size_t>(K.pixels())), cl::NDRange(64),
                           surface.vertices_world, new_labels_, region_of_label_, bricks.table(),
                           bricks.tableMask(), toKernel(surface.T_world_camera.inverse()),
                           toKernel(K.fx, K.fy, K.cx, K.cy), cl_int{K.width}, cl_int{K.height},
                           bricks.voxelSize(), reach, static_cast<cl_int>(params.voxel_confidence ? 1 : 0),
                           cl_int{stamp_}, labels_, stamps_, count_, touched_);
    cl_int count = 0;
    count_.read(compute_.queue(), std::span<cl_int>(&count, 1));
    touched_host_.resize(static_cast<std::size_t>(count));
    touched_.read(compute_.queue(), std::span<cl_int>(touched_host_));
    return touched_host_;
  }

  Extract extract(std::span<const cl_int> slots, const BrickMap& bricks, float truncation_vox) {
    fitPools(bricks);
    Extract result;
    result.first.push_back(0);
    if (slots.empty()) return result;
    fit(listed_, slots.size());
    fit(offsets_, slots.size());
    fit(points_, 1);
    listed_.write(compute_.queue(), slots);
    const auto run = [&](int write) {
      const auto band = static_cast<cl_int>(32767.0F / truncation_vox);
      kernels_.extract.launch(cl::NDRange(slots.size()), cl::NDRange(8), listed_,
                              static_cast<cl_int>(slots.size()), positions_, bricks.voxels(), labels_,
                              bricks.voxelSize(), band, cl_int{write}, offsets_, points_);
    };
    run(0);
    std::vector<cl_int> offsets(slots.size());
    offsets_.read(compute_.queue(), std::span<cl_int>(offsets));
    cl_int total = 0;
    for (cl_int& entry : offsets) {
      total += std::exchange(entry, total);
      result.first.push_back(static_cast<std::uint32_t>(total));
    }
    result.points.resize(static_cast<std::size_t>(total));
    if (total == 0) return result;
    fit(points_, result.points.size());
    offsets_.write(compute_.queue(), offsets);
    run(1);
    points_.read(compute_.queue(), std::span<LabelPoint>(result.points));
    return result;
  }

  [[nodiscard]] const Buffer<cl_uint>& labels() const { return labels_; }

 private:
  template <class T>
  void fit(Buffer<T>& buffer, std::size_t size) {
    if (buffer.size() < size) buffer = Buffer<T>(compute_.context(), size + size / 2);
  }

  /// Gives every slot of `bricks` its labels (0 when new), stamp and position.
  void fitPools(const BrickMap& bricks) {
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

  /// Allocates every brick that a voxel within `reach` of a vertex lies in.
  void makeMissingBricks(const SurfaceMaps& surface, float reach, BrickMap& bricks) {
    const int pixels = surface.K.pixels();
    for (;;) {
      count_.fill(compute_.queue(), 0);
      kernels_.list_missing.launch(cl::NDRange(static_cast<std::size_t>(pixels)), cl::NDRange(64),
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

  ComputeContext& compute_;
  LabelingKernels kernels_;
  Buffer<cl_uint> labels_;
  Buffer<cl_int> stamps_, touched_, count_, listed_, offsets_;
  Buffer<cl_int4> positions_, missing_;
  Buffer<cl_uint> projected_, new_labels_, region_of_label_;
  Buffer<LabelPoint> points_;
  std::vector<cl_int> touched_host_;
  cl_int stamp_ = 0;
  int positions_known_ = 0;
};

Result<std::unique_ptr<LabelCloud>> LabelCloud::create(ComputeContext& compute) {
  Result<LabelingKernels> built = buildKernels(compute);
  if (!built) return fail(built.error());
  std::unique_ptr<LabelCloud> cloud(new LabelCloud);
  cloud->machinery_ = std::make_unique<Machinery>(compute, std::move(*built));
  return cloud;
}

LabelCloud::~LabelCloud() = default;

std::vector<std::uint32_t> LabelCloud::project(const SurfaceMaps& surface, const BrickMap& bricks) {
  return machinery_->project(surface, bricks);
}

std::span<const cl_int> LabelCloud::update(const SurfaceMaps& surface, const RegionMap& merged,
                                           const LabelTable& table, const LabelingParams& params,
                                           BrickMap& bricks) {
  return machinery_->update(surface, merged, table, params, bricks);
}

LabelCloud::Extract LabelCloud::extract(std::span<const cl_int> slots, const BrickMap& bricks,
                                        float truncation_vox) {
  return machinery_->extract(slots, bricks, truncation_vox);
}

const Buffer<cl_uint>& LabelCloud::voxels() const { return machinery_->labels(); }
std::size_t LabelCloud::deviceBytes() const { return machinery_->labels().size() * sizeof(cl_uint); }

}  // namespace scantrove
