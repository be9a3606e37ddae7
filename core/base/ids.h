#pragma once
#include <compare>
#include <cstdint>
#include <functional>

namespace scantrove {

/// A typed integer id. Value 0 means "none" for every type.
template <class Tag>
struct Id {
  std::uint32_t value = 0;
  constexpr explicit operator bool() const { return value != 0; }
  auto operator<=>(const Id&) const = default;
};

using SegmentId = Id<struct SegmentTag>;    ///< a segment of one frame (S_t)
using FragmentId = Id<struct FragmentTag>;  ///< stored in the voxels; 24 bits
using RegionId = Id<struct RegionTag>;      ///< a set of fragments; its identity survives merges and splits
using ObjectId = Id<struct ObjectTag>;      ///< a row of the catalogue's table `objects`
using ClassId = Id<struct ClassTag>;        ///< a row of the catalogue's table `classes`

}  // namespace scantrove

template <class Tag>
struct std::hash<scantrove::Id<Tag>> {
  std::size_t operator()(scantrove::Id<Tag> id) const noexcept {
    return std::hash<std::uint32_t>{}(id.value);
  }
};
