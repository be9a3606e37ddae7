#include "core/capture/live/realsense_camera.h"

#include <linux/usb/video.h>
#include <linux/uvcvideo.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <opencv2/imgproc.hpp>
#include <thread>

namespace scantrove {

namespace {

using namespace std::chrono_literals;

// The extension unit of a D4xx that passes commands on to its hardware monitor.
constexpr std::uint8_t kMonitorUnit = 3;
constexpr std::uint8_t kMonitorSelector = 1;
constexpr int kMonitorTries = 5;
constexpr auto kMonitorPause = 20ms;

bool offersFormat(const VideoNodeFile& file, std::uint32_t format) {
  const auto formats = file.formats();
  return std::ranges::find(formats, format) != formats.end();
}

}  // namespace

std::string RealsenseCamera::Device::name() const {
  return usb.serial.empty() ? model : model + " " + usb.serial;
}

Error RealsenseCamera::nodeError(const std::string& what, int error, const VideoNode& node) const {
  return videoError(what + " " + node.name + " (" + device_.name() + ")", error, node.path, device_.usb);
}

Result<std::unique_ptr<RealsenseCamera>> RealsenseCamera::open(VideoSystem& system, const Device& device) {
  if (device.nodes.empty())
    return fail("The kernel has no video node for the " + device.name() + ".",
                "Load its driver: `sudo modprobe uvcvideo`. In a container: give it the devices, for example "
                "`docker run --device /dev/video0`.");
  std::unique_ptr<RealsenseCamera> camera(new RealsenseCamera(device));
  SCANTROVE_TRY(camera->openNodes(system));
  return camera;
}

Result<void> RealsenseCamera::openNodes(VideoSystem& system) {
  std::optional<Error> refused;
  std::unique_ptr<VideoNodeFile> depth, color;
  for (const VideoNode& node : device_.nodes) {
    int error = 0;
    auto file = VideoNodeFile::open(system, node.path, error);
    if (file == nullptr) {
      if (!refused) refused = nodeError("Cannot open", error, node);
      continue;
    }
    const bool may_be_depth = device_.depth_node.empty() || device_.depth_node == node.name;
    if (depth == nullptr && may_be_depth && offersFormat(*file, V4L2_PIX_FMT_Z16)) {
      depth_at_ = node;
      depth = std::move(file);
    } else if ((color == nullptr || node.usb_interface > color_at_.usb_interface) &&
               offersFormat(*file, V4L2_PIX_FMT_YUYV)) {
      // Some models offer infrared as YUYV, too; the colour camera has the last interface.
      color_at_ = node;
      color = std::move(file);
    }
  }
  if (depth == nullptr) {
    if (refused) return fail(*refused);
    return fail(
        "The " + device_.name() + " offers no depth images (Z16)" +
            (device_.depth_node.empty() ? "." : " at " + device_.depth_node + "."),
        "Unplug it and plug it in again; its depth node is one of those that `v4l2-ctl --list-devices` "
        "lists.");
  }
  SCANTROVE_TRY(moveInto(depth_, prepare(std::move(depth), depth_at_, V4L2_PIX_FMT_Z16)));
  if (color == nullptr) return {};
  return moveInto(color_, prepare(std::move(color), color_at_, V4L2_PIX_FMT_YUYV));
}

Result<std::unique_ptr<VideoStream>> RealsenseCamera::prepare(std::unique_ptr<VideoNodeFile> file,
                                                              const VideoNode& node, std::uint32_t format) {
  auto stream = VideoStream::prepare(std::move(file), {format, {{640, 480}, {848, 480}}});
  if (!stream) return fail(nodeError("Cannot set up", stream.error(), node));
  return std::move(*stream);
}

int RealsenseCamera::query(std::uint8_t request, std::span<std::uint8_t> data) const {
  uvc_xu_control_query query{};
  query.unit = kMonitorUnit;
  query.selector = kMonitorSelector;
  query.query = request;
  query.size = static_cast<std::uint16_t>(data.size());
  query.data = data.data();
  return depth_->file().control(UVCIOC_CTRL_QUERY, query);
}

Result<std::vector<std::uint8_t>> RealsenseCamera::readTable(RealsenseTable table) const {
  // Another unit with this number would have another length.
  std::array<std::uint8_t, 2> length{};
  const int error = query(UVC_GET_LEN, length);
  if (error != 0) return fail("It does not tell its calibration: " + std::string(std::strerror(error)) + ".");
  if (length[0] + 256 * length[1] != static_cast<int>(kRealsenseControlBytes))
    return fail("It tells its calibration in another way.");
  std::vector<std::uint8_t> command = realsenseTableCommand(table);
  if (const int refused = query(UVC_SET_CUR, command); refused != 0)
    return fail("It refuses to tell its calibration: " + std::string(std::strerror(refused)) + ".");
  Result<std::vector<std::uint8_t>> read = fail("It does not tell its calibration.");
  for (int i = 0; i < kMonitorTries; ++i) {
    std::this_thread::sleep_for(kMonitorPause);
    std::vector<std::uint8_t> answer(kRealsenseControlBytes, 0);
    if (query(UVC_GET_CUR, answer) != 0) continue;
    read = realsenseTableIn(answer);
    if (read) break;
  }
  return read;
}

Result<Intrinsics> RealsenseCamera::depthIntrinsics() const {
  const auto table = readTable(RealsenseTable::depth);
  return table ? realsenseDepthIntrinsics(*table, depthSize()) : fail(table.error());
}

Result<RealsenseColor> RealsenseCamera::colorCamera() const {
  const auto table = readTable(RealsenseTable::color);
  return table ? realsenseColorCamera(*table, colorSize(), isRealsenseD405(device_.usb.product))
               : fail(table.error());
}

void RealsenseCamera::undistortColor(const LensDistortion& lens, const Intrinsics& K) {
  if (!lens.isZero()) undistorter_.emplace(lens, K);
}

Result<void> RealsenseCamera::start() {
  if (const int error = depth_->start(); error != 0) return fail(nodeError("Cannot start", error, depth_at_));
  if (color_ == nullptr) return {};
  if (const int error = color_->start(); error != 0) return fail(nodeError("Cannot start", error, color_at_));
  return {};
}

Result<DepthColorStreams::Arrival> RealsenseCamera::wait(std::chrono::milliseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (true) {
    auto arrival = takeReady();
    if (!arrival || arrival->depth || arrival->color) return arrival;
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    if (left <= 0ms) return Arrival{};
    std::array<pollfd, 2> waiting{};
    std::size_t count = 0;
    for (const auto* const stream : {depth_.get(), color_.get()}) {
      if (stream != nullptr) waiting.at(count++) = {stream->file().descriptor(), POLLIN, 0};
    }
    const std::span<pollfd> polled = std::span(waiting).first(count);
    const int ready = depth_->file().system().poll(polled, left);
    if (ready == 0) return Arrival{};
    if (ready < 0 && ready != -EINTR) return fail(std::strerror(-ready));
    if (std::ranges::any_of(polled, [](const pollfd& one) { return (one.revents & ~POLLIN) != 0; }))
      return takeLast();
  }
}

/// A node reports that its stream is broken: the next attempt to take an image says why.
Result<DepthColorStreams::Arrival> RealsenseCamera::takeLast() {
  auto arrival = takeReady();
  if (!arrival || arrival->depth || arrival->color) return arrival;
  return fail("the stream was interrupted");
}

Result<DepthColorStreams::Arrival> RealsenseCamera::takeReady() {
  Arrival arrival;
  auto depth = depth_->take();
  if (!depth) return fail(std::strerror(depth.error()));
  arrival.depth = std::move(*depth);
  if (color_ == nullptr) return arrival;
  auto color = color_->take();
  if (!color) return fail(std::strerror(color.error()));
  arrival.color = std::move(*color);
  if (!arrival.color || arrival.color->image.empty()) return arrival;
  cv::Mat bgr;
  const cv::Mat& raw = arrival.color->image;
  cv::cvtColor(cv::Mat(raw.size(), CV_8UC2, raw.data, raw.step), bgr, cv::COLOR_YUV2BGR_YUYV);
  arrival.color->image = undistorter_ ? undistorter_->ofColor(bgr) : bgr;
  return arrival;
}

}  // namespace scantrove
