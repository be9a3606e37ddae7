#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace scantrove {

/// One connected USB device as the kernel reports it below /sys. Missing values stay empty or 0.
struct UsbDevice {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::string port;  ///< the kernel's name of its port: "1-2.3"
  std::string manufacturer;
  std::string name;
  std::string serial;
  int bus = 0;
  int number = 0;  ///< on its bus
  double speed_mbps = 0;
  std::vector<std::string> modules;  ///< kernel modules bound to its interfaces

  [[nodiscard]] std::string id() const;  ///< "045e:02ae"
  /// Its device node below `root`: dev/bus/usb/001/005; empty if bus or number is unknown.
  [[nodiscard]] std::filesystem::path node(const std::filesystem::path& root) const;
};

/// Reads `root`/sys/bus/usb/devices, sorted by port. Missing or unreadable files are no error; a device
/// without vendor and product is skipped.
[[nodiscard]] std::vector<UsbDevice> readUsbDevices(const std::filesystem::path& root);

}  // namespace scantrove
