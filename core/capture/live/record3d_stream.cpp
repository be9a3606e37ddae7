#include "core/capture/live/record3d_stream.h"

#include <algorithm>
#include <utility>

#include "core/capture/camera_intrinsics.h"
#include "core/capture/color_registration.h"
#include "core/image/metric_depth.h"

namespace scantrove {

namespace {

using namespace std::chrono_literals;

constexpr std::uint16_t kRecord3dPort = 1337;
constexpr auto kFirstFrameTimeout = 3000ms;
constexpr auto kRecord3dTimeout = 1000ms;
/// Messages that wait are skipped, but not without end: a phone that sends faster than this computer reads
/// must not keep next() from returning.
constexpr int kMostSkipped = 30;

std::string sizeOfImage(const cv::Size& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace

std::vector<CameraInfo> listRecord3dPhones() {
  std::vector<CameraInfo> cameras;
  const auto phones = connectedPhones();
  if (!phones) return cameras;
  for (const Phone& phone : *phones)
    cameras.push_back({"record3d:" + phone.udid, "iPhone or iPad with the app Record3D", "Apple", "usbmuxd"});
  return cameras;
}

Result<std::unique_ptr<FrameSource>> openRecord3dPhone(const std::string& uri, const SourceOptions& options) {
  const std::size_t colon = uri.find(':');
  const std::string which = colon == std::string::npos ? "" : uri.substr(colon + 1);
  const auto phones = connectedPhones();
  if (!phones) return fail(phones.error());
  const auto phone = std::ranges::find_if(
      *phones, [&](const Phone& candidate) { return which.empty() || candidate.udid == which; });
  if (phone == phones->end())
    return fail(which.empty() ? "No iPhone or iPad was found on USB."
                              : "No iPhone or iPad " + which + " was found on USB.",
                "Plug it in, unlock it, and trust this computer; `scantrove devices` then lists it.");
  auto connection = PhoneConnection::open(*phone, kRecord3dPort);
  if (!connection) return fail(connection.error());
  return Record3dStream::start(std::move(*connection), "iPhone " + phone->udid, options)
      .map([](std::unique_ptr<Record3dStream> stream) -> std::unique_ptr<FrameSource> { return stream; });
}

Result<std::unique_ptr<Record3dStream>> Record3dStream::start(std::unique_ptr<PhoneConnection> connection,
                                                              const std::string& name,
                                                              const SourceOptions& options) {
  std::unique_ptr<Record3dStream> stream(new Record3dStream(std::move(connection), options));
  SCANTROVE_TRY(stream->readFirst(name));
  return stream;
}

Result<void> Record3dStream::readFirst(const std::string& name) {
  info_.name = name;
  const auto newest = receiveNewest(Clock::now() + kFirstFrameTimeout);
  if (!newest) return fail(gone(newest.error()).error);
  if (!newest->message)
    return fail(name + " sends no frames.",
                "Press the record button in Record3D, with USB streaming chosen in its settings.");
  const auto first = decodeRecord3dMessage(*newest->message, "the first frame of " + name);
  return first ? setUp(*first) : fail(first.error());
}

Result<void> Record3dStream::setUp(const Record3dFrame& first) {
  info_.kind = "Record3D phone";
  info_.is_live = true;
  info_.has_poses = first.pose.has_value();
  info_.pose_origin = PoseOrigin::device;
  info_.intrinsics = depthCamera(first);
  SCANTROVE_TRY(checkIntrinsics(info_.intrinsics, options_.intrinsics ? "--intrinsics" : info_.name));
  color_size_ = first.color.size();
  const ColorRegistration color = options_.color_registration.value_or(ColorRegistration{});
  return moveInto(color_camera_, colorCameraFor(color, color_size_, info_.intrinsics, info_.name));
}

Intrinsics Record3dStream::depthCamera(const Record3dFrame& frame) const {
  const cv::Size size = frame.depth_m.size();
  if (!options_.intrinsics) return frame.color_K.resizedTo(size.width, size.height);
  Intrinsics K = *options_.intrinsics;
  K.width = size.width;
  K.height = size.height;
  return K;
}

FrameRead Record3dStream::next() {
  while (true) {
    FrameRead read = readOne();
    if (read.status != FrameRead::Status::frame || isSelected(read.frame.index)) return read;
  }
}

bool Record3dStream::isSelected(int index) const {
  return index >= options_.start && (index - options_.start) % options_.stride == 0;
}

FrameRead Record3dStream::readOne() {
  FrameRead read;
  auto newest = receiveNewest(Clock::now() + kRecord3dTimeout);
  if (!newest) return gone(newest.error());
  if (!newest->message) {
    read.status = FrameRead::Status::timeout;
    return read;
  }
  const double arrived_s = std::chrono::duration<double>(Clock::now() - started_).count();
  next_index_ += newest->older;
  const int index = next_index_++;
  auto decoded =
      decodeRecord3dMessage(*newest->message, "Frame " + std::to_string(index) + " of " + info_.name);
  if (decoded) {
    read = frameOf(std::move(*decoded), index, arrived_s);
  } else {
    read.status = FrameRead::Status::skipped;
    read.error = decoded.error();
  }
  read.dropped = newest->older;
  return read;
}

FrameRead Record3dStream::frameOf(Record3dFrame decoded, int index, double timestamp_s) {
  const Intrinsics K = depthCamera(decoded);
  if (K.width != info_.intrinsics.width || K.height != info_.intrinsics.height ||
      decoded.color.size() != color_size_)
    return resized(decoded);
  FrameRead read;
  if (const auto checked = checkIntrinsics(K, "frame " + std::to_string(index) + " of " + info_.name);
      !checked) {
    read.status = FrameRead::Status::skipped;
    read.error = checked.error();
    return read;
  }
  read.status = FrameRead::Status::frame;
  RgbdFrame& frame = read.frame;
  frame.index = index;
  frame.timestamp_s = timestamp_s;
  // --depth-scale, where it is given, is the number of the phone's units in a metre.
  const double phone_units_per_meter = options_.depth_scale.value_or(1);
  frame.meters_per_unit = static_cast<float>(1 / kMetricUnitsPerMeter);
  frame.depth =
      toDepthUnits(decoded.depth_m, static_cast<float>(phone_units_per_meter / kMetricUnitsPerMeter));
  frame.color = decoded.color;
  frame.color_camera = color_camera_;
  frame.confidence = decoded.confidence;
  frame.intrinsics = K;
  frame.T_world_camera = decoded.pose;
  return read;
}

Result<Record3dStream::Newest> Record3dStream::receiveNewest(Clock::time_point deadline) {
  Newest newest;
  while (true) {
    auto message = messages_.next();
    if (!message) return fail(message.error());
    if (*message) {
      newest.older += newest.message ? 1 : 0;
      newest.message = std::move(*message);
      if (newest.older >= kMostSkipped) return newest;
      continue;
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
    const auto received = connection_->receive(newest.message ? 0ms : std::max(left, 0ms));
    // A frame that arrived before the end of the connection is still good; the next call reports the end.
    if (!received && newest.message) return newest;
    if (!received) return fail(received.error());
    if (received->empty() && (newest.message || left <= 0ms)) return newest;
    messages_.add(*received);
  }
}

FrameRead Record3dStream::resized(const Record3dFrame& frame) const {
  FrameRead read;
  read.status = FrameRead::Status::failed;
  read.error = {info_.name + " changed the size of its images to " + sizeOfImage(frame.color.size()) +
                    " (colour) and " + sizeOfImage(frame.depth_m.size()) + " (depth).",
                "Open it again: a scan has one size of images."};
  return read;
}

FrameRead Record3dStream::gone(const Error& reason) const {
  FrameRead read;
  read.status = FrameRead::Status::failed;
  read.error = {info_.name + " does not answer any more: " + reason.what + ".",
                "Keep Record3D open and streaming, then open the phone again."};
  return read;
}

}  // namespace scantrove
