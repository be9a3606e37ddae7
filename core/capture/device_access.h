#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "core/capture/usb_devices.h"

namespace scantrove {

/// The group with read and write access to a node; empty: only the node's owner, or the group is root's.
[[nodiscard]] std::string groupWithAccess(const std::filesystem::path& node);

/// A command that gives the local user and a group access to the nodes of `device`. `subsystem`: "usb" or
/// "video4linux".
[[nodiscard]] std::string udevRuleFor(const UsbDevice& device, std::string_view subsystem);

}  // namespace scantrove
