#pragma once
#include <span>

#include "core/evaluation/hdf5_handle.h"

namespace scantrove {

/// Part of an array: the first element and the number of elements of each dimension.
struct Hdf5Part {
  std::span<const hsize_t> start, count;
};

/// Whether the array has a form that HDF5 reads within bounds: stored in the file itself, whole or in chunks
/// of at most 1 GB, plain or compressed as MATLAB does (shuffle, deflate). HDF5 1.10 believes the sizes in a
/// file.
[[nodiscard]] bool hasSafeForm(const Hdf5Dataset& dataset);

/// Whether H5Dread() of `part` stays within its buffers: what it reads lies in the file of `file_bytes`, and
/// each compressed chunk unpacks to exactly a chunk. Unpacks those chunks once. Only if hasSafeForm().
[[nodiscard]] bool isSafeToRead(const Hdf5Dataset& dataset, const Hdf5Part& part, hsize_t file_bytes);

}  // namespace scantrove
