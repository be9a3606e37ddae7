#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/capture/usb_devices.h"

namespace scantrove {

/// A video node of a USB device.
struct VideoNode {
  std::string name;            ///< on this computer: "/dev/video2"
  std::filesystem::path path;  ///< the same below the root that was read
  int number = 0;              ///< 2
  int usb_interface = 0;       ///< 3 for the kernel's interface "1-2:1.3"
};

/// The nodes below `root`/sys/class/video4linux that belong to `device`, by number. Missing files are no
/// error. Opens no node.
[[nodiscard]] std::vector<VideoNode> videoNodesOf(const UsbDevice& device, const std::filesystem::path& root);

}  // namespace scantrove
