#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "core/capture/usb_devices.h"

namespace scantrove {

/// What a user does who may not open `node` of `device`: joins the node's group, or adds a udev rule.
/// `subsystem`: "usb" or "video4linux".
[[nodiscard]] std::string accessAdvice(const UsbDevice& device, const std::filesystem::path& node,
                                       std::string_view subsystem);

}  // namespace scantrove
