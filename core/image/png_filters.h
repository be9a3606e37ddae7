#pragma once
#include <cstddef>
#include <cstdint>

namespace scantrove {

inline constexpr std::size_t kPngPixelSize = 2;  ///< bytes of a grey 16-bit pixel

/// Undoes the filters of a grey 16-bit PNG in place (PNG specification, 9.2). `rows`: height rows, each the
/// number of its filter and then 2 width bytes, big endian. Returns whether all filters were known.
[[nodiscard]] bool undoPngFilters(std::uint8_t* rows, std::size_t width, std::size_t height);

}  // namespace scantrove
