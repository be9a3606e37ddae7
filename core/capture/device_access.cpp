#include "core/capture/device_access.h"

#include <grp.h>
#include <sys/stat.h>

namespace scantrove {
namespace {

/// The group with read and write access to a node; empty: only the node's owner, or the group is root's.
std::string groupWithAccess(const std::filesystem::path& node) {
  struct stat status {};
  constexpr mode_t kBoth = S_IRGRP | S_IWGRP;
  if (stat(node.c_str(), &status) != 0 || (status.st_mode & kBoth) != kBoth || status.st_gid == 0) {
    return {};
  }
  const group* const entry = getgrgid(status.st_gid);
  return entry == nullptr ? "" : entry->gr_name;
}

/// A command that gives the local user and a group access to the nodes of `device`.
std::string udevRuleFor(const UsbDevice& device, std::string_view subsystem) {
  const std::string id = device.id();
  const std::string vendor = id.substr(0, 4);
  const std::string product = id.substr(5);
  // A video node is a child of the USB device, whose identity is an attribute of a parent.
  const bool is_usb = subsystem == "usb";
  const std::string attribute = is_usb ? "ATTR" : "ATTRS";
  return "echo 'SUBSYSTEM==\"" + std::string(subsystem) + "\", " + attribute + "{idVendor}==\"" + vendor +
         "\", " + attribute + "{idProduct}==\"" + product + "\", MODE=\"0660\", GROUP=\"" +
         (is_usb ? "plugdev" : "video") + "\", TAG+=\"uaccess\"' | sudo tee /etc/udev/rules.d/60-camera-" +
         vendor + "-" + product + ".rules && sudo udevadm control --reload && sudo udevadm trigger";
}

}  // namespace

std::string accessAdvice(const UsbDevice& device, const std::filesystem::path& node,
                         std::string_view subsystem) {
  if (const std::string group = groupWithAccess(node); !group.empty())
    return "Its group may: `sudo adduser \"$USER\" " + group + "`, then log in again.";
  return "Allow it, then plug it in again: `" + udevRuleFor(device, subsystem) + "`";
}

}  // namespace scantrove
