#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

namespace scantrove {

/// The driver through which Scantrove opens a camera on Debian 12.
enum class CameraDriver {
  openni2,      ///< Debian's libopenni2-0
  libfreenect,  ///< Debian's libfreenect0.5
  v4l2,         ///< the kernel's uvcvideo
  none,         ///< no driver in Debian 12
};

/// A USB device of a depth camera.
struct KnownCamera {
  /// A camera may consist of several USB devices; only one of them sends images.
  enum class Part {
    camera,
    motor,  ///< of a Kinect v1; visible even without its power supply
    other,  ///< microphones, hubs and other devices that a scan does not need
  };

  std::uint16_t vendor = 0;
  std::uint16_t product = 0;  ///< 0: any product not listed itself
  std::string_view name;
  Part part = Part::camera;
  CameraDriver driver = CameraDriver::none;
  double needed_mbps = 0;        ///< minimum USB speed for images
  std::string_view advice = {};  ///< for cameras without driver
};

/// Table entry of a USB device; empty if it is no listed depth camera.
[[nodiscard]] std::optional<KnownCamera> findKnownCamera(std::uint16_t vendor, std::uint16_t product);

}  // namespace scantrove
