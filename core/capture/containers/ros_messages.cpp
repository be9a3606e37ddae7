#include "core/capture/containers/ros_messages.h"

#include <algorithm>
#include <cmath>

namespace scantrove {

namespace {

constexpr std::size_t kCdrHeaderBytes = 4;
constexpr std::uint32_t kLongestRosText = 1 << 16;

/// Whether the numbers of a CDR message are big-endian, and the largest alignment; none: an encoding that
/// recorders do not write (parameter lists).
struct CdrFormat {
  bool is_big_endian = false;
  std::size_t largest_unit = 8;
};

std::optional<CdrFormat> cdrFormat(ByteView message) {
  if (message.size() < kCdrHeaderBytes || message[0] != 0) return std::nullopt;
  switch (message[1]) {
    case 0:
    case 1:
      return CdrFormat{message[1] == 0, 8};
    case 6:  // the second version aligns to 4 at most
    case 7:
      return CdrFormat{message[1] == 6, 4};
    default:
      return std::nullopt;
  }
}

/// Reads the fields of a message in their order. ROS 1 has no padding; CDR pads each number to its own size
/// and ends texts with a zero.
class RosReader {
 public:
  RosReader(ByteView message, MessageEncoding encoding) : cursor_({}) {
    if (encoding == MessageEncoding::ros1) {
      cursor_ = ByteCursor(message);
      return;
    }
    const auto format = encoding == MessageEncoding::cdr ? cdrFormat(message) : std::nullopt;
    if (!format) {
      cursor_.skip(1);  // fails
      return;
    }
    is_cdr_ = true;
    largest_unit_ = format->largest_unit;
    cursor_ = ByteCursor(message.subspan(kCdrHeaderBytes), format->is_big_endian);
  }

  [[nodiscard]] bool isOk() const { return cursor_.isOk(); }

  template <class Number>
  [[nodiscard]] Number get() {
    if (is_cdr_) cursor_.align(std::min(sizeof(Number), largest_unit_));
    return cursor_.get<Number>();
  }
  template <std::size_t kCount>
  [[nodiscard]] std::array<double, kCount> getAll() {
    std::array<double, kCount> values{};
    for (double& value : values) value = get<double>();
    return values;
  }
  [[nodiscard]] std::string text() {
    const auto length = get<std::uint32_t>();
    if (length > kLongestRosText) cursor_.skip(~std::uint64_t{0});  // fails
    std::string_view text = cursor_.takeText(length);
    if (is_cdr_ && text.ends_with('\0')) text.remove_suffix(1);
    return std::string(text);
  }
  [[nodiscard]] ByteView bytes() { return cursor_.take(get<std::uint32_t>()); }

  [[nodiscard]] RosHeader header() {
    constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
    if (!is_cdr_) static_cast<void>(get<std::uint32_t>());  // seq
    RosHeader header;
    const std::int64_t seconds =
        is_cdr_ ? std::int64_t{get<std::int32_t>()} : std::int64_t{get<std::uint32_t>()};
    header.stamp_ns = seconds * kNanosecondsPerSecond + get<std::uint32_t>();
    header.frame = text();
    return header;
  }

  /// None: not finite, or no rotation.
  [[nodiscard]] std::optional<Eigen::Isometry3d> transform() {
    const std::array<double, 7> values = getAll<7>();
    const Eigen::Quaterniond rotation(values[6], values[3], values[4], values[5]);
    const bool is_finite = std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
    // Recorders may leave all zeros where they know none.
    constexpr double kShortest = 0.5;
    if (!isOk() || !is_finite || rotation.norm() < kShortest || rotation.norm() > 1 / kShortest)
      return std::nullopt;
    Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
    transform.linear() = rotation.normalized().toRotationMatrix();
    transform.translation() = Eigen::Vector3d(values[0], values[1], values[2]);
    return transform;
  }

 private:
  ByteCursor cursor_;
  bool is_cdr_ = false;
  std::size_t largest_unit_ = 8;
};

template <class Message>
std::optional<Message> ifComplete(const RosReader& reader, Message message) {
  return reader.isOk() ? std::optional(std::move(message)) : std::nullopt;
}

}  // namespace

std::optional<RosHeader> decodeRosHeader(ByteView message, MessageEncoding encoding) {
  RosReader reader(message, encoding);
  RosHeader header = reader.header();
  return ifComplete(reader, std::move(header));
}

std::optional<RosImage> decodeRosImage(ByteView message, MessageEncoding encoding, bool has_data) {
  RosReader reader(message, encoding);
  RosImage image;
  image.header = reader.header();
  image.height = reader.get<std::uint32_t>();
  image.width = reader.get<std::uint32_t>();
  image.encoding = reader.text();
  image.is_big_endian = reader.get<std::uint8_t>() != 0;
  image.step = reader.get<std::uint32_t>();
  if (has_data) image.data = reader.bytes();
  return ifComplete(reader, std::move(image));
}

std::optional<RosCompressedImage> decodeRosCompressedImage(ByteView message, MessageEncoding encoding,
                                                           bool has_data) {
  RosReader reader(message, encoding);
  RosCompressedImage image;
  image.header = reader.header();
  image.format = reader.text();
  if (has_data) image.data = reader.bytes();
  return ifComplete(reader, std::move(image));
}

std::optional<RosCameraInfo> decodeRosCameraInfo(ByteView message, MessageEncoding encoding) {
  constexpr std::uint32_t kMostCoefficients = 14;
  RosReader reader(message, encoding);
  RosCameraInfo info;
  static_cast<void>(reader.header());
  info.height = reader.get<std::uint32_t>();
  info.width = reader.get<std::uint32_t>();
  info.model = reader.text();
  const auto count = reader.get<std::uint32_t>();
  if (count > kMostCoefficients) return std::nullopt;
  for (std::uint32_t i = 0; i < count; ++i) info.D.push_back(reader.get<double>());
  info.K = reader.getAll<9>();
  static_cast<void>(reader.getAll<9>());  // R
  info.P = reader.getAll<12>();
  return ifComplete(reader, std::move(info));
}

std::optional<float> decodeRosFloat(ByteView message, MessageEncoding encoding) {
  RosReader reader(message, encoding);
  const auto value = reader.get<float>();
  return ifComplete(reader, value);
}

std::optional<std::string> decodeRosString(ByteView message, MessageEncoding encoding) {
  RosReader reader(message, encoding);
  std::string text = reader.text();
  return ifComplete(reader, std::move(text));
}

std::optional<Eigen::Isometry3d> decodeRosTransform(ByteView message, MessageEncoding encoding) {
  return RosReader(message, encoding).transform();
}

std::optional<std::vector<RosTransform>> decodeRosTransforms(ByteView message, MessageEncoding encoding) {
  constexpr std::uint32_t kMostTransforms = 10'000;
  RosReader reader(message, encoding);
  const auto count = reader.get<std::uint32_t>();
  if (count > kMostTransforms) return std::nullopt;
  std::vector<RosTransform> transforms;
  for (std::uint32_t i = 0; i < count && reader.isOk(); ++i) {
    RosTransform transform;
    transform.parent = reader.header().frame;
    transform.child = reader.text();
    const auto T = reader.transform();
    if (!reader.isOk()) return std::nullopt;
    if (!T) continue;
    transform.T_parent_child = *T;
    transforms.push_back(std::move(transform));
  }
  return ifComplete(reader, std::move(transforms));
}

}  // namespace scantrove
