#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "core/compute/buffer.h"
#include "core/compute/compute_context.h"

namespace scantrove {

/// A device copy of a growing host array; sends only changed elements. The context's thread.
template <class T>
class DeviceMirror {
 public:
  /// Updates the device's copy from `host`: the elements `changed` (any order) and those past the old end.
  /// When `host` outgrows the buffer, copies all of it to a new one.
  void update(ComputeContext& compute, std::span<const T> host, std::span<const std::size_t> changed) {
    if (host.size() > buffer_.size()) {
      buffer_ = Buffer<T>(compute.context(), std::max(host.size(), 2 * buffer_.size()));
      sent_ = 0;
    } else if (compute.isCpu() ? changed.size() > host.size() / 2 : runsIn(changed) > kFewRuns) {
      sent_ = 0;
    } else if (compute.isCpu()) {
      writeInPlace(compute, host, changed);
    } else {
      writeRuns(compute, host, changed);
    }
    buffer_.write(compute.queue(), host.subspan(sent_), sent_);
    sent_ = host.size();
    compute.finish();
  }

  [[nodiscard]] const Buffer<T>& buffer() const { return buffer_; }

 private:
  static constexpr std::size_t kFewRuns = 4096;

  /// End of the run of consecutive indices that starts at changed[first].
  static std::size_t endOfRun(std::span<const std::size_t> changed, std::size_t first) {
    std::size_t end = first + 1;
    while (end < changed.size() && changed[end] == changed[end - 1] + 1) ++end;
    return end;
  }
  static std::size_t runsIn(std::span<const std::size_t> changed) {
    std::size_t runs = 0;
    for (std::size_t first = 0; first < changed.size(); first = endOfRun(changed, first)) ++runs;
    return runs;
  }

  void writeRuns(ComputeContext& compute, std::span<const T> host, std::span<const std::size_t> changed) {
    for (std::size_t first = 0, end = 0; first < changed.size(); first = end) {
      end = endOfRun(changed, first);
      const std::size_t i = changed[first];
      compute.queue().enqueueWriteBuffer(buffer_.cl(), CL_FALSE, i * sizeof(T), (end - first) * sizeof(T),
                                         &host[i]);
    }
  }

  // In host memory, mapping a buffer makes no copy.
  void writeInPlace(ComputeContext& compute, std::span<const T> host, std::span<const std::size_t> changed) {
    if (changed.empty()) return;
    void* mapped =
        compute.queue().enqueueMapBuffer(buffer_.cl(), CL_TRUE, CL_MAP_WRITE, 0, host.size_bytes());
    T* device = static_cast<T*>(mapped);
    for (const std::size_t i : changed) device[i] = host[i];
    compute.queue().enqueueUnmapMemObject(buffer_.cl(), mapped);
  }

  Buffer<T> buffer_;
  std::size_t sent_ = 0;
};

}  // namespace scantrove
