#include "core/fusion/brick_pools.h"

#include <algorithm>
#include <iterator>

#include "core/base/check.h"

namespace scantrove {
namespace {

constexpr std::size_t kBrickVoxels = BRICK_VOXELS;
static_assert(VOXEL_BYTES == sizeof(cl_short) + sizeof(cl_uchar) + 2 * sizeof(cl_uint));

std::size_t voxelsOf(int slots) { return static_cast<std::size_t>(slots) * kBrickVoxels; }

template <class T>
void growPool(ComputeContext& compute, Buffer<T>& pool, int slots, int used) {
  Buffer<T> larger(compute.context(), voxelsOf(slots));
  if (used > 0) {
    compute.queue().enqueueCopyBuffer(pool.cl(), larger.cl(), 0, 0, voxelsOf(used) * sizeof(T));
  }
  compute.finish();
  pool = larger;
}

/// Calls `visit(first slot, count, index in slots)` for each run of consecutive slots.
template <class Visit>
void forEachRun(std::span<const int> slots, const Visit& visit) {
  for (std::size_t first = 0, last = 0; first < slots.size(); first = last) {
    last = first + 1;
    while (last < slots.size() && slots[last] == slots[last - 1] + 1) ++last;
    visit(slots[first], static_cast<int>(last - first), first);
  }
}

/// Calls `visit(voxels, count, index in slots)` for each run, on a device that shares the host's memory.
template <class T, class Visit>
void onHost(ComputeContext& compute, const Buffer<T>& pool, std::span<const int> slots, cl_map_flags access,
            const Visit& visit) {
  if (slots.empty()) return;
  const auto [lowest, highest] = std::ranges::minmax_element(slots);
  const int first = *lowest;
  void* mapped = compute.queue().enqueueMapBuffer(pool.cl(), CL_TRUE, access, voxelsOf(first) * sizeof(T),
                                                  voxelsOf(*highest - first + 1) * sizeof(T));
  T* const voxels = static_cast<T*>(mapped);
  forEachRun(slots, [&](int slot, int count, std::size_t place) {
    visit(voxels + voxelsOf(slot - first), voxelsOf(count), place * kBrickVoxels);
  });
  compute.queue().enqueueUnmapMemObject(pool.cl(), mapped);
}

template <class T>
void clearPool(ComputeContext& compute, Buffer<T>& pool, std::span<const int> slots) {
  if (compute.isCpu()) {
    onHost(compute, pool, slots, CL_MAP_WRITE,
           [](T* to, std::size_t count, std::size_t) { std::fill_n(to, count, T{}); });
    return;
  }
  forEachRun(slots, [&](int slot, int count, std::size_t) {
    pool.fill(compute.queue(), T{}, voxelsOf(slot), voxelsOf(count));
  });
}

template <class T>
void readPool(ComputeContext& compute, const Buffer<T>& pool, std::span<const int> slots,
              std::vector<T>& values) {
  SCANTROVE_CHECK(values.size() == slots.size() * kBrickVoxels);
  if (compute.isCpu()) {
    onHost(compute, pool, slots, CL_MAP_READ, [&](const T* from, std::size_t count, std::size_t place) {
      std::copy_n(from, count, values.data() + place);
    });
    return;
  }
  forEachRun(slots, [&](int slot, int count, std::size_t place) {
    compute.queue().enqueueReadBuffer(pool.cl(), CL_FALSE, voxelsOf(slot) * sizeof(T),
                                      voxelsOf(count) * sizeof(T), values.data() + place * kBrickVoxels);
  });
}

template <class T>
void writePool(ComputeContext& compute, Buffer<T>& pool, std::span<const int> slots,
               const std::vector<T>& values) {
  SCANTROVE_CHECK(values.size() == slots.size() * kBrickVoxels);
  if (compute.isCpu()) {
    onHost(compute, pool, slots, CL_MAP_WRITE, [&](T* to, std::size_t count, std::size_t place) {
      std::copy_n(values.data() + place, count, to);
    });
    return;
  }
  forEachRun(slots, [&](int slot, int count, std::size_t place) {
    compute.queue().enqueueWriteBuffer(pool.cl(), CL_FALSE, voxelsOf(slot) * sizeof(T),
                                       voxelsOf(count) * sizeof(T), values.data() + place * kBrickVoxels);
  });
}

}  // namespace

bool BrickPools::makeAtOnce(int slots) {
  try {
    auto distances = Buffer<cl_short>::zeroed(compute_.context(), voxelsOf(slots));
    auto weights = Buffer<cl_uchar>::zeroed(compute_.context(), voxelsOf(slots));
    auto labels = Buffer<cl_uint>::zeroed(compute_.context(), voxelsOf(slots));
    auto colors = Buffer<cl_uint>::zeroed(compute_.context(), voxelsOf(slots));
    // A driver may defer an allocation until its first use.
    distances.fill(compute_.queue(), DISTANCE_UNSEEN, 0, 1);
    weights.fill(compute_.queue(), 0, 0, 1);
    labels.fill(compute_.queue(), 0U, 0, 1);
    colors.fill(compute_.queue(), 0U, 0, 1);
    compute_.finish();
    distances_ = distances;
    weights_ = weights;
    labels_ = labels;
    colors_ = colors;
    capacity_ = slots;
    return true;
  } catch (const cl::Error&) {
    return false;
  }
}

// Voxels of unassigned slots are never read and need no value.
void BrickPools::grow(int slots, int used) {
  if (slots <= capacity_) return;
  growPool(compute_, distances_, slots, used);
  growPool(compute_, weights_, slots, used);
  growPool(compute_, labels_, slots, used);
  growPool(compute_, colors_, slots, used);
  capacity_ = zero_from_ = slots;
}

void BrickPools::use(std::span<const int> slots) {
  if (!slots.empty()) zero_from_ = std::max(zero_from_, *std::ranges::max_element(slots) + 1);
}

void BrickPools::clear(std::span<const int> slots) {
  std::vector<int> used;
  std::ranges::copy_if(slots, std::back_inserter(used), [this](int slot) { return slot < zero_from_; });
  use(slots);
  // The system maps memory that is read before it is written to a zero page, and replaces that later while
  // stopping all cores. Every brick gets distances, so write at once.
  clearPool(compute_, distances_, slots);
  clearPool(compute_, weights_, slots);
  clearPool(compute_, labels_, std::span(used));
  clearPool(compute_, colors_, std::span(used));
}

BrickContents BrickPools::read(std::span<const int> slots) const {
  BrickContents contents(slots.size());
  readPool(compute_, distances_, slots, contents.distances);
  readPool(compute_, weights_, slots, contents.weights);
  readPool(compute_, labels_, slots, contents.labels);
  readPool(compute_, colors_, slots, contents.colors);
  compute_.finish();
  return contents;
}

void BrickPools::write(std::span<const int> slots, const BrickContents& contents) {
  use(slots);
  writePool(compute_, distances_, slots, contents.distances);
  writePool(compute_, weights_, slots, contents.weights);
  writePool(compute_, labels_, slots, contents.labels);
  writePool(compute_, colors_, slots, contents.colors);
  compute_.finish();
}

}  // namespace scantrove
