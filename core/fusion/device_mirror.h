#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "core/compute/buffer.h"
#include "core/compute/compute_context.h"

namespace scantrove {

/// A device copy of a host array that grows; only what changed is sent. The context's thread.
template <class T>
class DeviceMirror {
 public:
  /// Makes the device's copy equal to `host`, of which the elements `changed` (any order) and those past the
  /// old end are new since the last call. When `host` outgrows the buffer, a new one takes all of it.
  void update(ComputeContext& compute, std::span<const T> host, std::span<const std::size_t> changed) {
    if (host.size() > buffer_.size()) {
      buffer_ = Buffer<T>(compute.context(), std::max(host.size(), 2 * buffer_.size()));
      sent_ = 0;
    } else if (changed.size() > kFewChanges) {
      sent_ = 0;
    } else if (compute.isCpu()) {
      writeInPlace(compute, host, changed);
    } else {
      for (const std::size_t i : changed) {
        compute.queue().enqueueWriteBuffer(buffer_.cl(), CL_FALSE, i * sizeof(T), sizeof(T), &host[i]);
      }
    }
    buffer_.write(compute.queue(), host.subspan(sent_), sent_);
    sent_ = host.size();
    compute.finish();
  }

  [[nodiscard]] const Buffer<T>& buffer() const { return buffer_; }

 private:
  static constexpr std::size_t kFewChanges = 4096;

  // The memory is the host's: no copy is made of a mapped buffer.
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
