#include "core/capture/containers/realsense_recording.h"

#include <cmath>

#include "core/base/text.h"
#include "core/capture/containers/realsense_text.h"
#include "core/capture/containers/ros_messages.h"

namespace scantrove {

namespace {

constexpr std::string_view kRealsenseImageEnd = "/image/data";
constexpr std::size_t kLargestRealsenseText = 64 << 10;

/// "/device_0/sensor_0/Depth_0" of "/device_0/sensor_0/Depth_0/image/data".
std::string realsenseStream(const std::string& topic) {
  return topic.substr(0, topic.size() - kRealsenseImageEnd.size());
}

/// A number as std_msgs/Float32 or as text.
std::optional<double> numberFrom(MessageFile& file, const MessageTopic& topic) {
  const Result<ByteBlock> message = file.read(topic.messages.back(), kLargestRealsenseText);
  if (!message) return std::nullopt;
  if (topic.type == "std_msgs/Float32") {
    const auto value = decodeRosFloat(*message, topic.encoding);
    return value ? std::optional(static_cast<double>(*value)) : std::nullopt;
  }
  const auto text = decodeRosString(*message, topic.encoding);
  const auto values = text ? parseNumbers(*text) : std::nullopt;
  return values && values->size() == 1 ? std::optional(values->front()) : std::nullopt;
}

std::optional<double> metadataUnit(MessageFile& file, const std::string& stream) {
  const MessageTopic* const topic = file.findTopic(stream + "/image/metadata");
  if (topic == nullptr || topic->type != "std_msgs/String") return std::nullopt;
  const Result<ByteBlock> message = file.read(topic->messages.front(), kLargestRealsenseText);
  const auto text = message ? decodeRosString(*message, topic->encoding) : std::nullopt;
  const auto values = text ? parseNumbers(realsenseValue(*text, "depth_units")) : std::nullopt;
  return values && values->size() == 1 ? std::optional(values->front()) : std::nullopt;
}

/// A transform from the group's reference stream to a stream, and the name of the group.
struct RealsensePlace {
  std::string group;
  Eigen::Isometry3d T_stream_reference;
};

std::optional<RealsensePlace> realsensePlace(MessageFile& file, const std::string& stream) {
  const std::string start = stream + "/tf/";
  for (const MessageTopic& topic : file.topics()) {
    if (!topic.name.starts_with(start)) continue;
    const Result<ByteBlock> message = file.read(topic.messages.front(), kLargestRealsenseText);
    if (!message) continue;
    std::optional<Eigen::Isometry3d> T;
    if (topic.type == "std_msgs/String") {
      const auto text = decodeRosString(*message, topic.encoding);
      if (text) T = realsenseTransform(*text);
    } else {
      T = decodeRosTransform(*message, topic.encoding);
    }
    if (T) return RealsensePlace{topic.name.substr(start.size()), *T};
  }
  return std::nullopt;
}

}  // namespace

bool isRealsenseTopic(const std::string& topic) {
  return topic.starts_with("/device_") && topic.find("/sensor_") != std::string::npos &&
         topic.ends_with(kRealsenseImageEnd);
}

std::optional<double> realsenseDepthUnit(MessageFile& file, const std::string& depth_topic) {
  const std::string stream = realsenseStream(depth_topic);
  const std::string sensor = stream.substr(0, stream.rfind('/'));
  std::optional<double> unit;
  for (const char* option : {"/option/Depth Units/value", "/option/Depth_Units/value"}) {
    const MessageTopic* const topic = file.findTopic(sensor + option);
    if (topic != nullptr && !unit) unit = numberFrom(file, *topic);
  }
  if (!unit) unit = metadataUnit(file, stream);
  return unit && std::isfinite(*unit) && *unit > 0 ? unit : std::nullopt;
}

std::optional<Eigen::Isometry3d> realsenseColorPlace(MessageFile& file, const std::string& depth_topic,
                                                     const std::string& color_topic) {
  const auto depth = realsensePlace(file, realsenseStream(depth_topic));
  const auto color = realsensePlace(file, realsenseStream(color_topic));
  if (!depth || !color || depth->group != color->group) return std::nullopt;
  return color->T_stream_reference * depth->T_stream_reference.inverse();
}

}  // namespace scantrove
