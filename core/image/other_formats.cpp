#include "core/image/other_formats.h"

#include <dlfcn.h>

#include <array>

#include "core/image/other_formats_abi.h"

namespace scantrove {
namespace {

constexpr const char* kLibrary = "libscantrove_other_formats.so";

struct Loaded {
  ScantroveDecodeOtherFormat* decode = nullptr;
  std::string why_not;
};

/// By the program's run path. It stays for the rest of the process.
Loaded load() {
  void* const library = ::dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
  void* const function = library != nullptr ? ::dlsym(library, SCANTROVE_DECODE_OTHER_FORMAT) : nullptr;
  if (function != nullptr) return {reinterpret_cast<ScantroveDecodeOtherFormat*>(function), {}};
  const char* const error = ::dlerror();
  return {nullptr, error != nullptr ? error : kLibrary};
}

}  // namespace

Result<cv::Mat> decodeOtherFormat(std::span<const std::uint8_t> bytes, PictureWay way,
                                  const std::string& name) {
  static const Loaded codecs = load();
  if (codecs.decode == nullptr) {
    return fail(name + " cannot be decoded: a part of the program is missing (" + codecs.why_not + ").",
                "Install Scantrove whole, or save the pictures as PNG or JPEG.");
  }
  cv::Mat image;
  std::array<char, 256> reason{};
  if (codecs.decode(bytes.data(), bytes.size(), way == PictureWay::to_color ? 1 : 0, &image, reason.data(),
                    reason.size()) != 0)
    return fail(name + " cannot be decoded: " + reason.data() + ".");
  return image;
}

}  // namespace scantrove
