#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace scantrove {

/// Whether the bytes are a JPEG or a PNG of three channels of 8 bits, which every program reads alike.
[[nodiscard]] bool isPlainColor(std::span<const std::uint8_t> bytes);

/// Removes orientation tags (Exif, XMP) from a JPEG or PNG, so that every program shows the pixels as the
/// camera model describes them. Compressed pixels stay the same bytes. Images without a tag or tagged
/// "upright", and other formats, stay unchanged.
[[nodiscard]] std::string withoutOrientation(std::string bytes);

}  // namespace scantrove
