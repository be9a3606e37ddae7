#pragma once
#include <span>
#include <type_traits>
#include <vector>

#include "core/base/check.h"
#include "core/compute/host_memory.h"
#include "core/compute/opencl.h"

namespace scantrove {

/// `size()` elements of T in device memory, shared by all copies of the handle and freed with the last. All
/// calls on the context's thread; all may throw cl::Error (out of memory, device lost).
template <class T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Buffer() = default;
  Buffer(const cl::Context& context, std::size_t size)
      : buffer_(context, CL_MEM_READ_WRITE, (size == 0 ? 1 : size) * sizeof(T)), size_(size) {}
  /// Zeroed elements, which a CPU device keeps in host memory; untouched pages take no memory.
  [[nodiscard]] static Buffer zeroed(const cl::Context& context, std::size_t size) {
    Buffer buffer;
    buffer.buffer_ = zeroedOnHost(context, (size == 0 ? 1 : size) * sizeof(T));
    buffer.size_ = size;
    return buffer;
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const cl::Buffer& cl() const { return buffer_; }

  /// Copies all of `values` to elements [first, first + values.size()). Blocks until `values` may be reused.
  void write(cl::CommandQueue& queue, std::span<const T> values, std::size_t first = 0) {
    SCANTROVE_CHECK(first + values.size() <= size_);
    if (values.empty()) return;
    queue.enqueueWriteBuffer(buffer_, CL_TRUE, first * sizeof(T), values.size_bytes(), values.data());
  }

  /// Fills `values` from elements [first, first + values.size()). Blocks until done.
  void read(cl::CommandQueue& queue, std::span<T> values, std::size_t first = 0) const {
    SCANTROVE_CHECK(first + values.size() <= size_);
    if (values.empty()) return;
    queue.enqueueReadBuffer(buffer_, CL_TRUE, first * sizeof(T), values.size_bytes(), values.data());
  }

  [[nodiscard]] std::vector<T> read(cl::CommandQueue& queue) const {
    std::vector<T> values(size_);
    read(queue, std::span<T>(values));
    return values;
  }

  /// Sets elements [first, first + count) to `value`.
  void fill(cl::CommandQueue& queue, const T& value, std::size_t first, std::size_t count) {
    SCANTROVE_CHECK(first + count <= size_);
    if (count > 0) queue.enqueueFillBuffer(buffer_, value, first * sizeof(T), count * sizeof(T));
  }
  void fill(cl::CommandQueue& queue, const T& value) { fill(queue, value, 0, size_); }

 private:
  cl::Buffer buffer_;
  std::size_t size_ = 0;
};

}  // namespace scantrove
