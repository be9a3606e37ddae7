#include "core/image/numpy_image.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/regular_file.h"
#include "core/base/text.h"
#include "core/image/file_bytes.h"
#include "core/image/image_header.h"

namespace scantrove {

namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
/// Longest header that is read; NumPy itself writes 118 bytes.
constexpr std::size_t kMaxHeaderBytes = 1 << 16;

struct NumpyHeader {
  std::string type;  ///< such as "<f4"
  bool is_column_major = false;
  std::vector<std::size_t> shape;
  std::size_t data_at = 0;  ///< first byte of the elements
};

/// The text behind `'key':` in the header's dictionary; empty if it is missing.
std::string_view valueOf(std::string_view header, std::string_view key) {
  const std::size_t at = header.find("'" + std::string(key) + "'");
  const std::size_t colon = at == std::string_view::npos ? at : header.find(':', at);
  return colon == std::string_view::npos ? std::string_view() : trimmed(header.substr(colon + 1));
}

std::optional<std::vector<std::size_t>> parseShape(std::string_view text) {
  const std::size_t end = text.find(')');
  if (!text.starts_with('(') || end == std::string_view::npos) return std::nullopt;
  text = text.substr(1, end - 1);
  std::vector<std::size_t> shape;
  while (!trimmed(text).empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::string_view digits = trimmed(text.substr(0, comma));
    std::size_t size = 0;
    const auto [stopped, error] = std::from_chars(digits.data(), digits.data() + digits.size(), size);
    if (error != std::errc() || stopped != digits.data() + digits.size()) return std::nullopt;
    shape.push_back(size);
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return shape;
}

std::optional<NumpyHeader> parseHeader(std::string_view start) {
  const std::span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(start.data()),
                                            start.size());
  if (!start.starts_with(kMagic) || start.size() < kMagic.size() + 4) return std::nullopt;
  const bool is_first_version = start[kMagic.size()] == 1;
  const std::size_t length_at = kMagic.size() + 2, length_bytes = is_first_version ? 2 : 4;
  const std::size_t text_at = length_at + length_bytes;
  const std::size_t length = numberAt(bytes, length_at, length_bytes, false);
  if (start.size() < text_at || length > start.size() - text_at) return std::nullopt;
  const std::string_view text = start.substr(text_at, length);
  const std::string_view type = valueOf(text, "descr");
  auto shape = parseShape(valueOf(text, "shape"));
  if (type.size() < 4 || type.front() != '\'' || !shape) return std::nullopt;
  return NumpyHeader{std::string(type.substr(1, type.find('\'', 1) - 1)),
                     valueOf(text, "fortran_order").starts_with("True"), std::move(*shape), text_at + length};
}

/// OpenCV's type of the elements in the file; empty: not read here.
std::optional<int> elementType(std::string_view type) {
  const std::string_view kind = type.size() == 3 ? type.substr(1) : std::string_view();
  if (kind == "u1" || kind == "b1") return CV_8UC1;
  if (kind == "u2") return CV_16UC1;
  if (kind == "f2") return CV_16FC1;
  if (kind == "f4") return CV_32FC1;
  if (kind == "f8") return CV_64FC1;
  return std::nullopt;
}

void swapBytes(cv::Mat& image) {
  const auto size = static_cast<std::ptrdiff_t>(image.elemSize());
  for (auto *at = image.data, *end = at + image.total() * image.elemSize(); at != end; at += size)
    std::reverse(at, at + size);
}

}  // namespace

Result<cv::Mat> readNumpyImage(const std::filesystem::path& file) {
  const auto start = readFile(file, kMaxHeaderBytes);
  if (!start) return fail(start.error());
  auto header = parseHeader(*start);
  if (!header) return fail(file.string() + " is no NumPy array, or it is truncated.");
  std::vector<std::size_t> shape = header->shape;
  if (shape.size() == 3) std::erase(shape, std::size_t{1});
  const auto type = elementType(header->type);
  if (!type || shape.size() != 2)
    return fail(file.string() + " is an array of type '" + header->type + "' with " +
                    std::to_string(header->shape.size()) + " dimensions, not one image of depths.",
                "Save h x w arrays of uint16, float16, float32 or float64.");
  if (header->is_column_major) std::swap(shape[0], shape[1]);
  constexpr std::size_t kMaxSide = UINT32_MAX;
  SCANTROVE_TRY(checkImageSize({static_cast<std::uint32_t>(std::min(shape[1], kMaxSide)),
                                static_cast<std::uint32_t>(std::min(shape[0], kMaxSide))},
                               file.string()));
  const std::size_t needed = shape[0] * shape[1] * static_cast<std::size_t>(CV_ELEM_SIZE(*type));
  const auto bytes = readFile(file, header->data_at + needed);
  if (!bytes) return fail(bytes.error());
  if (bytes->size() < header->data_at + needed)
    return fail(file.string() + " is truncated (" + std::to_string(bytes->size()) + " bytes).");
  cv::Mat image(static_cast<int>(shape[0]), static_cast<int>(shape[1]), *type);
  std::memcpy(image.data, bytes->data() + header->data_at, needed);
  if ((header->type[0] == '>') != (std::endian::native == std::endian::big)) swapBytes(image);
  if (header->is_column_major) image = image.t();
  if (image.depth() != CV_8U && image.depth() != CV_16U) image.convertTo(image, CV_32F);
  return image;
}

}  // namespace scantrove
