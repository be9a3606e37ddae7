#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace scantrove {

/// Whether the bytes are a JPEG or a PNG of three channels of 8 bits: what every program reads alike.
[[nodiscard]] bool isPlainColor(std::span<const std::uint8_t> bytes);

/// The bytes of a JPEG or PNG without what tells other programs to turn or mirror it (Exif, XMP): the image
/// is then, for all of them, what its pixels are, and what its camera belongs to. The compressed pixels stay
/// the same bytes, as does an image that says nothing or "upright"; other formats stay as they are.
[[nodiscard]] std::string withoutOrientation(std::string bytes);

}  // namespace scantrove
