#include "core/capture/live/video_nodes.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <system_error>

#include "core/base/text.h"

namespace scantrove {

namespace {

constexpr std::string_view kNodeName = "video";

/// The USB interface that a node belongs to, "1-2:1.3"; empty if it belongs to none.
std::string interfaceOf(const std::filesystem::path& node) {
  std::error_code error;
  const std::string name = std::filesystem::canonical(node / "device", error).filename().string();
  return error || name.find(':') == std::string::npos ? std::string() : name;
}

std::optional<VideoNode> nodeOf(const std::filesystem::path& entry, const UsbDevice& device,
                                const std::filesystem::path& root) {
  const std::string name = entry.filename().string();
  if (!name.starts_with(kNodeName)) return std::nullopt;
  const auto number = parseFrameNumber(std::string_view(name).substr(kNodeName.size()));
  const std::string interface = interfaceOf(entry);
  if (!number || interface.empty() || interface.substr(0, interface.find(':')) != device.port)
    return std::nullopt;
  return VideoNode{"/dev/" + name, root / "dev" / name, *number,
                   static_cast<int>(lastNumber(interface).value_or(0))};
}

}  // namespace

std::vector<VideoNode> videoNodesOf(const UsbDevice& device, const std::filesystem::path& root) {
  std::vector<VideoNode> nodes;
  std::error_code error;
  for (std::filesystem::directory_iterator at(root / "sys/class/video4linux", error), end;
       !error && at != end; at.increment(error)) {
    if (auto node = nodeOf(at->path(), device, root)) nodes.push_back(std::move(*node));
  }
  std::ranges::sort(nodes, {}, &VideoNode::number);
  return nodes;
}

}  // namespace scantrove
