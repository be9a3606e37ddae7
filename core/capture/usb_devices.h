#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace scantrove {

/// One USB device that is plugged in, as the kernel tells of it below /sys. What it does not tell stays empty
/// or 0.
struct UsbDevice {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::string port;  ///< the kernel's name of where it is plugged in: "1-2.3"
  std::string manufacturer;
  std::string name;
  std::string serial;
  int bus = 0;
  int number = 0;  ///< on its bus
  double speed_mbps = 0;
  std::vector<std::string> modules;  ///< of the kernel, that hold its interfaces

  [[nodiscard]] std::string id() const;  ///< "045e:02ae"
  /// The node through which programs use it, below `root`: dev/bus/usb/001/005; empty if the bus or the
  /// number is not known.
  [[nodiscard]] std::filesystem::path node(const std::filesystem::path& root) const;
};

/// Reads `root`/sys/bus/usb/devices, sorted by port. Nothing there, or a file that cannot be read, is no
/// error; a device without vendor and product is left out.
[[nodiscard]] std::vector<UsbDevice> readUsbDevices(const std::filesystem::path& root);

}  // namespace scantrove
