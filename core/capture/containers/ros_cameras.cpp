#include "core/capture/containers/ros_cameras.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/text.h"
#include "core/capture/containers/realsense_text.h"
#include "core/capture/folder_listing.h"

namespace scantrove {

namespace {

constexpr std::uint32_t kLargestRosSide = 16384;

/// The lens of a distortion model; none: a pinhole, or a model that is not supported (with a warning).
std::optional<LensDistortion> rosLens(const std::string& model, const std::vector<double>& D,
                                      const std::string& topic) {
  const auto at = [&](std::size_t i) { return i < D.size() ? D[i] : 0.0; };
  if (std::ranges::all_of(D, [](double value) { return value == 0; }) ||
      !std::ranges::all_of(D, [](double value) { return std::isfinite(value); }))
    return std::nullopt;
  const std::string lower = lowerCase(model);
  const bool is_brown = lower.empty() || lower.find("plumb") != std::string::npos ||
                        lower.find("rational") != std::string::npos ||
                        lower.find("brown") != std::string::npos;
  if (!is_brown) {
    if (lower != "none")
      spdlog::warn("{}: the lens model '{}' is not supported; its images are used as they are.", topic,
                   model.substr(0, 40));
    return std::nullopt;
  }
  LensDistortion lens{at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)};
  lens.is_inverse = lower.starts_with("inverse");
  return lens;
}

std::optional<RosCamera> cameraFrom(const RosCameraInfo& info, const std::string& image_topic) {
  const bool is_rectified =
      lowerCase(image_topic).find("rect") != std::string::npos && info.P[0] > 0 && info.P[5] > 0;
  const auto value = [&](std::size_t of_K, std::size_t of_P) {
    return static_cast<float>(is_rectified ? info.P[of_P] : info.K[of_K]);
  };
  RosCamera camera;
  camera.K = {value(0, 0), value(4, 5), value(2, 2), value(5, 6), 0, 0};
  if (info.width > 0 && info.height > 0 && info.width <= kLargestRosSide && info.height <= kLargestRosSide) {
    camera.K.width = static_cast<int>(info.width);
    camera.K.height = static_cast<int>(info.height);
  }
  if (!(camera.K.fx > 0 && camera.K.fy > 0)) return std::nullopt;
  if (!is_rectified) camera.lens = rosLens(info.model, info.D, image_topic);
  return camera;
}

/// Parent of a coordinate system, and T_parent_child.
using TransformTree = std::map<std::string, std::pair<std::string, Eigen::Isometry3d>>;

TransformTree readTransformTree(MessageFile& file) {
  TransformTree tree;
  for (const char* name : {"/tf_static", "tf_static", "/tf", "tf"}) {
    const MessageTopic* const topic = file.findTopic(name);
    if (topic == nullptr) continue;
    for (const MessageEntry& entry : topic->messages) {
      constexpr std::size_t kLargest = 4 << 20;
      const Result<ByteBlock> message = file.read(entry, kLargest);
      const auto transforms = message ? decodeRosTransforms(*message, topic->encoding) : std::nullopt;
      if (!transforms) continue;
      for (const RosTransform& one : *transforms)
        tree.try_emplace(rosFrameName(one.child), rosFrameName(one.parent), one.T_parent_child);
    }
  }
  return tree;
}

/// A coordinate system above another one, and T_above_frame.
using FramesAbove = std::vector<std::pair<std::string, Eigen::Isometry3d>>;

FramesAbove framesAbove(const TransformTree& tree, const std::string& frame) {
  constexpr std::size_t kDeepest = 100;  // ends circles
  FramesAbove above{{frame, Eigen::Isometry3d::Identity()}};
  while (above.size() < kDeepest) {
    const auto parent = tree.find(above.back().first);
    if (parent == tree.end()) break;
    const Eigen::Isometry3d T = parent->second.second * above.back().second;
    above.emplace_back(parent->second.first, T);
  }
  return above;
}

}  // namespace

std::string rosFrameName(const std::string& frame) {
  return frame.starts_with('/') ? frame.substr(1) : frame;
}

std::optional<RosCamera> readRosCamera(MessageFile& file, const MessageTopic& info,
                                       const std::string& image_topic) {
  constexpr std::size_t kLargest = 64 << 10;
  for (const MessageEntry& entry : info.messages) {
    const Result<ByteBlock> message = file.read(entry, kLargest);
    if (!message) continue;
    std::optional<RosCameraInfo> camera;
    if (info.type == "std_msgs/String") {
      const auto text = decodeRosString(*message, info.encoding);
      if (text) camera = realsenseCameraInfo(*text);
    } else {
      camera = decodeRosCameraInfo(*message, info.encoding);
    }
    if (camera) return cameraFrom(*camera, image_topic);
  }
  return std::nullopt;
}

std::optional<Eigen::Isometry3d> readRosTransform(MessageFile& file, const std::string& to,
                                                  const std::string& from) {
  const TransformTree tree = readTransformTree(file);
  const FramesAbove above_to = framesAbove(tree, rosFrameName(to));
  for (const auto& [frame, T_frame_from] : framesAbove(tree, rosFrameName(from))) {
    const auto common =
        std::ranges::find_if(above_to, [&name = frame](const auto& one) { return one.first == name; });
    if (common != above_to.end()) return common->second.inverse() * T_frame_from;
  }
  return std::nullopt;
}

}  // namespace scantrove
