#include "core/capture/usb_devices.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <optional>
#include <system_error>

#include "core/base/text.h"

namespace scantrove {

namespace {

namespace fs = std::filesystem;

/// First line of a kernel attribute file; empty if it cannot be read.
std::string readLine(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return std::string(trimmed(line));
}

/// `text` as a number; 0 if it is none.
template <class Number>
Number numberIn(const std::string& text, int base) {
  Number number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  return error == std::errc{} && end == text.data() + text.size() ? number : Number{0};
}

/// Last path component of a link's target; empty if there is none.
std::string targetName(const fs::path& link) {
  std::error_code error;
  return fs::read_symlink(link, error).filename().string();
}

/// The kernel module bound to an interface: its driver's module, or the driver's name if built in.
std::string moduleOf(const fs::path& interface) {
  const std::string module = targetName(interface / "driver" / "module");
  return module.empty() ? targetName(interface / "driver") : module;
}

/// "1-2.3:1.0" is an interface of "1-2.3".
std::string portOf(const std::string& interface) { return interface.substr(0, interface.find(':')); }

UsbDevice readDevice(const fs::path& folder) {
  UsbDevice device;
  device.port = folder.filename().string();
  device.vendor = numberIn<std::uint16_t>(readLine(folder / "idVendor"), 16);
  device.product = numberIn<std::uint16_t>(readLine(folder / "idProduct"), 16);
  device.manufacturer = readLine(folder / "manufacturer");
  device.name = readLine(folder / "product");
  device.serial = readLine(folder / "serial");
  device.bus = numberIn<int>(readLine(folder / "busnum"), 10);
  device.number = numberIn<int>(readLine(folder / "devnum"), 10);
  const auto speed = parseNumbers(readLine(folder / "speed"));
  device.speed_mbps = speed && speed->size() == 1 ? speed->front() : 0;
  return device;
}

std::string formatted(const char* format, unsigned first, unsigned second) {
  char text[32];
  std::snprintf(text, sizeof text, format, first, second);
  return text;
}

}  // namespace

std::string UsbDevice::id() const { return formatted("%04x:%04x", vendor, product); }

fs::path UsbDevice::node(const fs::path& root) const {
  if (bus <= 0 || number <= 0) {
    return {};
  }
  return root / "dev/bus/usb" /
         formatted("%03u/%03u", static_cast<unsigned>(bus), static_cast<unsigned>(number));
}

std::vector<UsbDevice> readUsbDevices(const fs::path& root) {
  std::vector<UsbDevice> devices;
  std::vector<fs::path> interfaces;
  std::error_code error;
  for (fs::directory_iterator at(root / "sys/bus/usb/devices", error), end; !error && at != end;
       at.increment(error)) {
    if (at->path().filename().string().find(':') != std::string::npos) {
      interfaces.push_back(at->path());
    } else if (UsbDevice device = readDevice(at->path()); device.vendor != 0 && device.product != 0) {
      devices.push_back(std::move(device));
    }
  }
  std::ranges::sort(devices, {}, &UsbDevice::port);
  std::ranges::sort(interfaces);
  for (const fs::path& interface : interfaces) {
    const auto device = std::ranges::find(devices, portOf(interface.filename().string()), &UsbDevice::port);
    const std::string module = moduleOf(interface);
    if (device != devices.end() && !module.empty() && std::ranges::count(device->modules, module) == 0) {
      device->modules.push_back(module);
    }
  }
  return devices;
}

}  // namespace scantrove
