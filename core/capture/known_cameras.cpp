#include "core/capture/known_cameras.h"

#include <algorithm>
#include <iterator>

namespace scantrove {

namespace {

using Part = KnownCamera::Part;
using Driver = CameraDriver;

constexpr std::uint16_t kMicrosoft = 0x045e;
constexpr std::uint16_t kPrimeSense = 0x1d27;
constexpr std::uint16_t kOrbbec = 0x2bc5;
constexpr std::uint16_t kIntel = 0x8086;
constexpr double kHighSpeed = 480;    // USB 2.0
constexpr double kSuperSpeed = 5000;  // USB 3.0

constexpr std::string_view kRealsenseAdvice =
    "Record with RealSense Viewer (a .bag or .db3 file) and open that file.";
constexpr std::string_view kAzureKinectAdvice = "Record with k4arecorder (an .mkv file) and open that file.";
constexpr std::string_view kKinectV2Advice =
    "The library libfreenect2, which Debian has not, comes with a driver for OpenNI2: build it and put it "
    "into "
    "OpenNI2's folder of drivers. Or record with it (colour and depth as numbered PNG files) and open that "
    "folder.";
constexpr std::string_view kOrbbecAdvice =
    "Orbbec's SDK for OpenNI2 brings a driver: put its liborbbec.so into OpenNI2's folder of drivers "
    "(see docs/cameras.md); `camera` then opens it. Or record with its maker's software (an .oni file, or "
    "colour and depth as numbered PNG files) and open that.";
constexpr std::string_view kPrimeSenseAdvice =
    "OpenNI2's drivers do not know this model. If `camera` does not open it, record with its maker's "
    "software.";

// OpenNI2: the ids that Debian's drivers libPS1080 (0500 - 0609) and libPSLink (1250 - 1290) accept.
// libfreenect: the two cameras that it accepts. v4l2: RealSense's series D400, whose format of depth (Z16)
// the kernel knows.
constexpr KnownCamera kTable[] = {
    {kMicrosoft, 0x02ae, "Kinect v1 (Xbox 360)", Part::camera, Driver::libfreenect, kHighSpeed},
    {kMicrosoft, 0x02bf, "Kinect v1 (for Windows)", Part::camera, Driver::libfreenect, kHighSpeed},
    {kMicrosoft, 0x02b0, "Kinect v1: motor", Part::motor},
    {kMicrosoft, 0x02c2, "Kinect v1: motor (newer model)", Part::motor},
    {kMicrosoft, 0x02ad, "Kinect v1: microphones", Part::other},
    {kMicrosoft, 0x02be, "Kinect v1: microphones", Part::other},
    {kMicrosoft, 0x02bb, "Kinect v1: microphones", Part::other},
    {kMicrosoft, 0x02c3, "Kinect v1: microphones", Part::other},
    {kMicrosoft, 0x02c4, "Kinect v2", Part::camera, Driver::none, kSuperSpeed, kKinectV2Advice},
    {kMicrosoft, 0x02d8, "Kinect v2", Part::camera, Driver::none, kSuperSpeed, kKinectV2Advice},
    {kMicrosoft, 0x02d9, "Kinect v2: hub", Part::other},
    {kMicrosoft, 0x097a, "Azure Kinect: hub", Part::other},
    {kMicrosoft, 0x097c, "Azure Kinect", Part::camera, Driver::none, kSuperSpeed, kAzureKinectAdvice},
    {kMicrosoft, 0x097d, "Azure Kinect: colour", Part::other},
    {kPrimeSense, 0x0500, "PrimeSense PS1080", Part::camera, Driver::openni2, kHighSpeed},
    {kPrimeSense, 0x0600, "Asus Xtion", Part::camera, Driver::openni2, kHighSpeed},
    {kPrimeSense, 0x0601, "Asus Xtion Pro Live", Part::camera, Driver::openni2, kHighSpeed},
    {kPrimeSense, 0x0609, "PrimeSense Carmine", Part::camera, Driver::openni2, kHighSpeed},
    {kPrimeSense, 0x1250, "PrimeSense PS1250", Part::camera, Driver::openni2, kHighSpeed},
    {kPrimeSense, 0x1260, "PrimeSense PS1260", Part::camera, Driver::openni2, kHighSpeed},
    {kPrimeSense, 0x1270, "PrimeSense PS1270", Part::camera, Driver::openni2, kHighSpeed},
    {kPrimeSense, 0x1280, "PrimeSense Capri", Part::camera, Driver::openni2, kHighSpeed},
    {kPrimeSense, 0x1290, "PrimeSense PS1290", Part::camera, Driver::openni2, kHighSpeed},
    {kPrimeSense, 0, "PrimeSense camera", Part::camera, Driver::none, kHighSpeed, kPrimeSenseAdvice},
    {kOrbbec, 0, "Orbbec camera", Part::camera, Driver::none, kHighSpeed, kOrbbecAdvice},
    {kIntel, 0x0a66, "RealSense F200", Part::camera, Driver::none, kSuperSpeed, kRealsenseAdvice},
    {kIntel, 0x0a80, "RealSense R200", Part::camera, Driver::none, kSuperSpeed, kRealsenseAdvice},
    {kIntel, 0x0aa5, "RealSense SR300", Part::camera, Driver::none, kSuperSpeed, kRealsenseAdvice},
    {kIntel, 0x0ad1, "RealSense D400", Part::camera, Driver::v4l2, kHighSpeed},
    {kIntel, 0x0ad2, "RealSense D410", Part::camera, Driver::v4l2, kHighSpeed},
    {kIntel, 0x0ad3, "RealSense D415", Part::camera, Driver::v4l2, kHighSpeed},
    {kIntel, 0x0ad4, "RealSense D430", Part::camera, Driver::v4l2, kHighSpeed},
    {kIntel, 0x0ad5, "RealSense D430", Part::camera, Driver::v4l2, kHighSpeed},
    {kIntel, 0x0ad6, "RealSense D400", Part::camera, Driver::v4l2, kHighSpeed},
    {kIntel, 0x0af6, "RealSense D420", Part::camera, Driver::v4l2, kHighSpeed},
    {kIntel, 0x0b07, "RealSense D435", Part::camera, Driver::v4l2, kHighSpeed},
    {kIntel, 0x0b3a, "RealSense D435i", Part::camera, Driver::v4l2, kHighSpeed},
    {kIntel, 0x0b4b, "RealSense D430i", Part::camera, Driver::v4l2, kHighSpeed},
    {kIntel, 0x0b5b, "RealSense D405", Part::camera, Driver::v4l2, kHighSpeed},
    {kIntel, 0x0b5c, "RealSense D455", Part::camera, Driver::v4l2, kHighSpeed},
    {kIntel, 0x1155, "RealSense D421", Part::camera, Driver::v4l2, kHighSpeed},
    {kIntel, 0x0b64, "RealSense L515", Part::camera, Driver::none, kSuperSpeed, kRealsenseAdvice},
};

}  // namespace

std::optional<KnownCamera> findKnownCamera(std::uint16_t vendor, std::uint16_t product) {
  for (const std::uint16_t requested : {product, std::uint16_t{0}}) {
    const auto* const found = std::ranges::find_if(kTable, [&](const KnownCamera& known) {
      return known.vendor == vendor && known.product == requested;
    });
    if (found != std::end(kTable)) {
      return *found;
    }
  }
  return std::nullopt;
}

}  // namespace scantrove
