#include "core/image/exr_image.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>

#include <cstdint>
#include <exception>
#include <optional>
#include <string>

#include "core/base/regular_file.h"
#include "core/image/image_header.h"

namespace scantrove {

namespace {

/// The channel that holds depth; empty if that is unclear.
std::optional<std::string> depthChannel(const Imf::ChannelList& channels) {
  for (const char* const name : {"R", "Z", "Y"}) {
    if (channels.findChannel(name) != nullptr) return name;
  }
  auto second = channels.begin();
  if (second == channels.end() || ++second != channels.end()) return std::nullopt;
  return channels.begin().name();
}

std::uint32_t sideLength(int first, int last) {
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(last) - first + 1);
}

/// Throws what OpenEXR throws.
Result<cv::Mat> readChannel(const std::filesystem::path& file) {
  // Offset tables and line buffers follow the header's size: it must be refused before they are allocated.
  Imf::Header::setMaxImageSize(kLongestImageSide_px, kLongestImageSide_px);
  Imf::InputFile input(file.c_str(), 1);
  const Imath::Box2i window = input.header().dataWindow();
  const ImageSize size{sideLength(window.min.x, window.max.x), sideLength(window.min.y, window.max.y)};
  SCANTROVE_TRY(checkImageSize(size, file.string()));
  const auto name = depthChannel(input.header().channels());
  const Imf::Channel* const channel = name ? input.header().channels().findChannel(*name) : nullptr;
  if (channel == nullptr || channel->xSampling != 1 || channel->ySampling != 1)
    return fail(file.string() + " has no channel R, Z or Y that covers each pixel.",
                "Depth is expected as one channel of floating point, in metres.");
  cv::Mat1f image(static_cast<int>(size.height), static_cast<int>(size.width), 0.0F);
  Imf::FrameBuffer buffer;
  buffer.insert(*name, Imf::Slice::Make(Imf::FLOAT, image.data, window, sizeof(float), image.step[0]));
  input.setFrameBuffer(buffer);
  input.readPixels(window.min.y, window.max.y);
  return image;
}

}  // namespace

Result<cv::Mat> readExrImage(const std::filesystem::path& file) {
  SCANTROVE_TRY(checkRegularFile(file));
  try {
    return readChannel(file);
  } catch (const std::exception& exception) {
    return fail(file.string() + " cannot be decoded: it is damaged or truncated (" + exception.what() + ").");
  }
}

}  // namespace scantrove
