#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

namespace scantrove {

/// What can open a camera on Debian 12.
enum class CameraDriver {
  openni2,      ///< Debian's libopenni2-0
  libfreenect,  ///< Debian's libfreenect0.5
  none,         ///< Debian 12 has none
};

/// A USB device of a depth camera.
struct KnownCamera {
  /// A camera may be several USB devices; only one of them gives images.
  enum class Part {
    camera,
    motor,  ///< of a Kinect v1: there even without its power supply
    other,  ///< microphones, hubs and other things that a scan does not need
  };

  std::uint16_t vendor = 0;
  std::uint16_t product = 0;  ///< 0: any that is not in the table itself
  std::string_view name;
  Part part = Part::camera;
  CameraDriver driver = CameraDriver::none;
  double needed_mbps = 0;        ///< the USB speed below which no images come
  std::string_view advice = {};  ///< what one can do where there is no driver
};

/// What is known of a USB device; nothing if it is no depth camera that the table has.
[[nodiscard]] std::optional<KnownCamera> findKnownCamera(std::uint16_t vendor, std::uint16_t product);

}  // namespace scantrove
