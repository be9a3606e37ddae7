#pragma once
#include "core/compute/buffer.h"

namespace scantrove {

/// Replaces a buffer with fewer than `size` elements by one with room for more; the contents are lost.
template <class T>
void fitBuffer(const cl::Context& context, Buffer<T>& buffer, std::size_t size) {
  if (buffer.size() < size) buffer = Buffer<T>(context, size + size / 2);
}

}  // namespace scantrove
