#include "core/evaluation/hdf5_chunks.h"

#include <libdeflate.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace scantrove {
namespace {

/// HDF5 reads whole chunks. Those of MATLAB hold a few megabytes.
constexpr hsize_t kLargestChunkBytes = hsize_t{1} << 30;
/// An image of NYUv2 is one chunk or some dozens.
constexpr hsize_t kMostChunks = 100'000;

using Sides = std::array<hsize_t, H5S_MAX_RANK>;

/// Empty after an error.
struct ChunkForm {
  int rank = 0;
  Sides sides{};
  hsize_t bytes = 0;  ///< unpacked
  bool is_packed = false;
};

ChunkForm chunkFormOf(const Hdf5Dataset& dataset, const Hdf5Properties& properties) {
  ChunkForm form;
  const Hdf5Type type(H5Dget_type(dataset.id()));
  hsize_t bytes = type ? H5Tget_size(type.id()) : 0;
  const int rank = H5Pget_chunk(properties.id(), H5S_MAX_RANK, form.sides.data());
  if (rank < 1 || bytes == 0) return {};
  for (int i = 0; i < rank; ++i) {
    const hsize_t side = form.sides[static_cast<std::size_t>(i)];
    if (side == 0 || side > kLargestChunkBytes / bytes) return {};
    bytes *= side;
  }
  const int filters = H5Pget_nfilters(properties.id());
  if (filters < 0) return {};
  for (int i = 0; i < filters; ++i) {
    unsigned flags = 0;
    std::array<unsigned, 8> values{};
    std::size_t value_count = values.size();
    const H5Z_filter_t filter = H5Pget_filter2(properties.id(), static_cast<unsigned>(i), &flags,
                                               &value_count, values.data(), 0, nullptr, nullptr);
    const bool is_last = i + 1 == filters;
    // MATLAB compresses last, so that what is stored unpacks to a chunk.
    if (filter == H5Z_FILTER_DEFLATE ? !is_last : filter != H5Z_FILTER_SHUFFLE) return {};
    form.is_packed = filter == H5Z_FILTER_DEFLATE;
  }
  form.rank = rank;
  form.bytes = bytes;
  return form;
}

bool liesIn(haddr_t offset, hsize_t bytes, hsize_t file_bytes) {
  return offset != HADDR_UNDEF && offset <= file_bytes && bytes <= file_bytes - offset;
}

bool unpacksToAChunk(const Hdf5Dataset& dataset, const Sides& corner, hsize_t stored_bytes,
                     hsize_t chunk_bytes) {
  std::vector<std::uint8_t> stored(stored_bytes), chunk(chunk_bytes);
  std::uint32_t skipped = 0;
  if (H5Dread_chunk(dataset.id(), H5P_DEFAULT, corner.data(), &skipped, stored.data()) < 0) return false;
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> unpacker(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  // Without a place for the size, less than a chunk is an error, too.
  return unpacker && libdeflate_zlib_decompress(unpacker.get(), stored.data(), stored.size(), chunk.data(),
                                                chunk.size(), nullptr) == LIBDEFLATE_SUCCESS;
}

bool isChunkSafe(const Hdf5Dataset& dataset, const ChunkForm& form, const Sides& corner, hsize_t file_bytes) {
  unsigned skipped_filters = 0;
  haddr_t offset = HADDR_UNDEF;
  hsize_t stored_bytes = 0;
  if (H5Dget_chunk_info_by_coord(dataset.id(), corner.data(), &skipped_filters, &offset, &stored_bytes) < 0)
    return false;
  if (offset == HADDR_UNDEF) return true;  // never written: HDF5 fills it
  // HDF5 counts offsets from behind MATLAB's own header, so the file has this much and more.
  if (skipped_filters != 0 || !liesIn(offset, stored_bytes, file_bytes)) return false;
  return form.is_packed ? unpacksToAChunk(dataset, corner, stored_bytes, form.bytes)
                        : stored_bytes == form.bytes;
}

/// Visits the corners of all chunks that `part` touches, until one is not safe.
bool areChunksSafe(const Hdf5Dataset& dataset, const ChunkForm& form, const Hdf5Part& part,
                   hsize_t file_bytes) {
  const auto rank = static_cast<std::size_t>(form.rank);
  if (part.start.size() != rank || part.count.size() != rank) return false;
  Sides first{}, corner{};
  hsize_t chunks = 1;
  for (std::size_t i = 0; i < rank; ++i) {
    if (part.count[i] == 0) return false;
    first[i] = part.start[i] / form.sides[i] * form.sides[i];
    const hsize_t along =
        (part.start[i] + part.count[i] - 1) / form.sides[i] - part.start[i] / form.sides[i] + 1;
    if (along > kMostChunks / chunks) return false;
    chunks *= along;
  }
  for (corner = first;;) {
    if (!isChunkSafe(dataset, form, corner, file_bytes)) return false;
    std::size_t i = rank;
    while (i > 0) {
      --i;
      corner[i] += form.sides[i];
      if (corner[i] < part.start[i] + part.count[i]) break;
      corner[i] = first[i];
      if (i == 0) return true;
    }
  }
}

}  // namespace

bool hasSafeForm(const Hdf5Dataset& dataset) {
  const Hdf5Properties properties(H5Dget_create_plist(dataset.id()));
  if (!properties || H5Pget_external_count(properties.id()) != 0) return false;
  switch (H5Pget_layout(properties.id())) {
    case H5D_COMPACT:
    case H5D_CONTIGUOUS:
      return true;
    case H5D_CHUNKED:
      return chunkFormOf(dataset, properties).rank > 0;
    default:
      return false;
  }
}

bool isSafeToRead(const Hdf5Dataset& dataset, const Hdf5Part& part, hsize_t file_bytes) {
  const Hdf5Properties properties(H5Dget_create_plist(dataset.id()));
  if (!properties) return false;
  if (H5Pget_layout(properties.id()) == H5D_CHUNKED) {
    const ChunkForm form = chunkFormOf(dataset, properties);
    return form.rank > 0 && areChunksSafe(dataset, form, part, file_bytes);
  }
  const Hdf5Type type(H5Dget_type(dataset.id()));
  const Hdf5Space space(H5Dget_space(dataset.id()));
  const hssize_t elements = space ? H5Sget_simple_extent_npoints(space.id()) : 0;
  const hsize_t element_bytes = type ? H5Tget_size(type.id()) : 0;
  if (elements < 1 || element_bytes == 0 || static_cast<hsize_t>(elements) > file_bytes / element_bytes)
    return false;
  const hsize_t bytes = static_cast<hsize_t>(elements) * element_bytes;
  const hsize_t stored_bytes = H5Dget_storage_size(dataset.id());
  if (H5Pget_layout(properties.id()) == H5D_COMPACT) return stored_bytes == bytes;
  if (stored_bytes == 0) return true;  // never written
  return stored_bytes == bytes && liesIn(H5Dget_offset(dataset.id()), bytes, file_bytes);
}

}  // namespace scantrove
