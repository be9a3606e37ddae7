#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace scantrove {

/// What is wrong with the bytes of an image file before anything decodes them, as the end of a sentence ("is
/// truncated ..."); empty if nothing is. Decoders fill the rest of a truncated picture with grey and call it
/// a success, so PNG is walked chunk by chunk to its IEND, JPEG must reach its end marker, and PNM and BMP
/// have as many bytes as their headers tell. TIFF: only emptiness.
[[nodiscard]] std::string findImageDamage(std::span<const std::uint8_t> bytes);

}  // namespace scantrove
