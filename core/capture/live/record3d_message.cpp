#include "core/capture/live/record3d_message.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "core/capture/containers/byte_cursor.h"
#include "core/capture/lzfse_decoder.h"
#include "core/capture/phones/device_metadata.h"
#include "core/image/image_file.h"
#include "core/image/image_header.h"

namespace scantrove {

namespace {

constexpr std::size_t kPeerTalkHeaderBytes = 16, kPeerTalkSizeOffset = 12;
constexpr std::uint32_t kLidarDevice = 1;

ByteView bytesIn(std::string_view bytes) {
  return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

/// The numbers before the images.
struct MessageHeader {
  ImageSize color, depth, confidence;
  std::uint32_t color_bytes, depth_bytes, confidence_bytes, other_bytes, device;
  std::array<float, 4> intrinsics;  // fx, fy, cx, cy of the colour image
  std::array<float, 7> pose;        // qx, qy, qz, qw, x, y, z

  static MessageHeader from(ByteCursor& cursor) {
    MessageHeader header{};
    for (ImageSize* const size : {&header.color, &header.depth, &header.confidence}) {
      size->width = cursor.get<std::uint32_t>();
      size->height = cursor.get<std::uint32_t>();
    }
    for (std::uint32_t* const value : {&header.color_bytes, &header.depth_bytes, &header.confidence_bytes,
                                       &header.other_bytes, &header.device})
      *value = cursor.get<std::uint32_t>();
    for (float& value : header.intrinsics) value = cursor.get<float>();
    for (float& value : header.pose) value = cursor.get<float>();
    return header;
  }

  /// Bytes of the images and of what the app adds.
  [[nodiscard]] std::uint64_t contentBytes() const {
    return std::uint64_t{color_bytes} + depth_bytes + confidence_bytes + other_bytes;
  }
};

/// Decodes an LZFSE image of one `type` element a pixel.
Result<cv::Mat> decodePlane(std::string_view bytes, const ImageSize& size, int type,
                            const std::string& name) {
  SCANTROVE_TRY(checkImageSize(size, name));
  cv::Mat image(static_cast<int>(size.height), static_cast<int>(size.width), type);
  const std::size_t expected = image.total() * image.elemSize();
  const auto raw = decodeLzfse(bytes, expected, name);
  if (!raw) return fail(raw.error());
  if (raw->size() != expected)
    return fail(name + " has " + std::to_string(raw->size()) + " bytes instead of " +
                std::to_string(expected) + ".");
  std::memcpy(image.data, raw->data(), expected);
  return image;
}

/// The intrinsics fit the colour image that was sent, whatever size the header gives.
Intrinsics colorIntrinsicsOf(const MessageHeader& header, const cv::Mat& color) {
  const auto& [fx, fy, cx, cy] = header.intrinsics;
  return {fx, fy, cx, cy, color.cols, color.rows};
}

}  // namespace

Result<std::optional<std::string>> Record3dMessages::next() {
  const std::string_view left = std::string_view(pending_).substr(at_);
  if (left.size() >= kPeerTalkHeaderBytes) {
    ByteCursor size(bytesIn(left.substr(kPeerTalkSizeOffset)), true);
    const std::size_t bytes = size.get<std::uint32_t>();
    if (bytes > kMaxMessageBytes)
      return fail("it sends a frame of " + std::to_string(bytes) +
                  " bytes, which is more than Record3D's stream has");
    if (left.size() >= kPeerTalkHeaderBytes + bytes) {
      at_ += kPeerTalkHeaderBytes + bytes;
      return std::optional(std::string(left.substr(kPeerTalkHeaderBytes, bytes)));
    }
  }
  pending_.erase(0, at_);
  at_ = 0;
  return std::optional<std::string>();
}

Result<Record3dFrame> decodeRecord3dMessage(std::string_view message, const std::string& name) {
  ByteCursor cursor(bytesIn(message));
  const MessageHeader header = MessageHeader::from(cursor);
  if (!cursor.isOk() || header.contentBytes() > cursor.left())
    return fail(name + " is truncated: it has " + std::to_string(message.size()) + " bytes.",
                "Update Record3D if this goes on.");
  Record3dFrame frame;
  const ByteView jpeg = cursor.take(header.color_bytes);
  const std::string_view depth = cursor.takeText(header.depth_bytes);
  const std::string_view confidence = cursor.takeText(header.confidence_bytes);
  SCANTROVE_TRY(moveInto(frame.color, decodeColorImage(jpeg, "the colour image of " + name)));
  SCANTROVE_TRY(moveInto(frame.depth_m, decodePlane(depth, header.depth, CV_32FC1, "the depth of " + name)));
  if (header.confidence == header.depth && !confidence.empty())
    SCANTROVE_TRY(moveInto(frame.confidence,
                           decodePlane(confidence, header.confidence, CV_8UC1, "the confidence of " + name)));
  frame.color_K = colorIntrinsicsOf(header, frame.color);
  frame.is_lidar = header.device == kLidarDevice;
  if (frame.is_lidar) {
    const std::array<float, 7>& numbers = header.pose;
    frame.pose = fromArkitAxes(poseFromQuaternion(std::vector<double>(numbers.begin(), numbers.end())));
  }
  return frame;
}

}  // namespace scantrove
