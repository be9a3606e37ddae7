#include "core/capture/live/video_stream.h"

#include <linux/videodev2.h>

#include <cerrno>
#include <cstring>

#include "core/capture/device_access.h"
#include "core/image/image_header.h"

namespace scantrove {

namespace {

constexpr std::uint32_t kVideoBuffers = 4;  // 130 ms at 30 Hz
constexpr std::uint32_t kMaxFormats = 64;   // of one node
constexpr std::size_t kBytesPerPixel = 2;   // Z16 and YUYV
constexpr std::uint32_t kCapture = V4L2_BUF_TYPE_VIDEO_CAPTURE;

/// A structure of the kernel, with the type of buffers set.
template <class Structure>
Structure ofCapture() {
  Structure structure{};
  structure.type = kCapture;
  return structure;
}

std::string videoAdvice(int error, const std::filesystem::path& node, const UsbDevice& device) {
  switch (error) {
    case EACCES:
    case EPERM:
      return accessAdvice(device, node, "video4linux");
    case EBUSY:
      return "Another program uses it: close that one. `fuser -v " + node.string() + "` names it.";
    case ENOSPC:
      return "The USB port is too slow for it: use a USB 3 port of the computer itself and a USB 3 cable.";
    case ENODEV:
    case ENXIO:
    case ENOENT:
      return "Was it unplugged? Plug it in again.";
    default:
      return "Plug it in again; if that does not help, update its firmware and the kernel.";
  }
}

}  // namespace

Error videoError(const std::string& what, int error, const std::filesystem::path& node,
                 const UsbDevice& device) {
  return {what + ": " + std::strerror(error) + ".", videoAdvice(error, node, device)};
}

std::unique_ptr<VideoNodeFile> VideoNodeFile::open(VideoSystem& system, const std::filesystem::path& node,
                                                   int& error) {
  const int descriptor = system.open(node);
  error = descriptor < 0 ? -descriptor : 0;
  if (descriptor < 0) return nullptr;
  return std::unique_ptr<VideoNodeFile>(new VideoNodeFile(system, descriptor));
}

std::vector<std::uint32_t> VideoNodeFile::formats() const {
  v4l2_capability capability{};
  if (control(VIDIOC_QUERYCAP, capability) != 0) return {};
  const bool has_own = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0;
  const std::uint32_t abilities = has_own ? capability.device_caps : capability.capabilities;
  if ((abilities & V4L2_CAP_VIDEO_CAPTURE) == 0 || (abilities & V4L2_CAP_STREAMING) == 0) return {};
  std::vector<std::uint32_t> formats;
  for (std::uint32_t i = 0; i < kMaxFormats; ++i) {
    auto description = ofCapture<v4l2_fmtdesc>();
    description.index = i;
    if (control(VIDIOC_ENUM_FMT, description) != 0) break;
    formats.push_back(description.pixelformat);
  }
  return formats;
}

tl::expected<std::unique_ptr<VideoStream>, int> VideoStream::prepare(std::unique_ptr<VideoNodeFile> file,
                                                                     const Request& request) {
  std::unique_ptr<VideoStream> stream(new VideoStream(std::move(file)));
  int error = stream->setFormat(request);
  if (error == 0) error = stream->mapBuffers();
  if (error != 0) return tl::unexpected(error);
  return stream;
}

VideoStream::~VideoStream() {
  if (is_started_) {
    int type = kCapture;
    static_cast<void>(file_->control(VIDIOC_STREAMOFF, type));
  }
  for (const Mapped& mapped : buffers_) file_->system().unmap(mapped.memory, mapped.bytes);
}

int VideoStream::setFormat(const Request& request) {
  v4l2_format chosen{};
  for (const cv::Size& size : request.sizes) {
    auto format = ofCapture<v4l2_format>();
    format.fmt.pix.width = static_cast<std::uint32_t>(size.width);
    format.fmt.pix.height = static_cast<std::uint32_t>(size.height);
    format.fmt.pix.pixelformat = request.format;
    format.fmt.pix.field = V4L2_FIELD_ANY;
    if (const int error = file_->control(VIDIOC_S_FMT, format); error != 0) return error;
    chosen = format;
    if (size == cv::Size(static_cast<int>(format.fmt.pix.width), static_cast<int>(format.fmt.pix.height)))
      break;
  }
  const v4l2_pix_format& pixels = chosen.fmt.pix;
  if (pixels.pixelformat != request.format || !checkImageSize({pixels.width, pixels.height}, "image"))
    return EINVAL;
  size_ = {static_cast<int>(pixels.width), static_cast<int>(pixels.height)};
  bytes_per_line_ = std::max<std::size_t>(pixels.bytesperline, kBytesPerPixel * pixels.width);
  auto rate = ofCapture<v4l2_streamparm>();
  rate.parm.capture.timeperframe = {1, request.frames_per_second};
  // Without an answer the device keeps its own rate.
  const int error = file_->control(VIDIOC_S_PARM, rate);
  return error == EBUSY || error == ENODEV ? error : 0;
}

int VideoStream::mapBuffers() {
  auto request = ofCapture<v4l2_requestbuffers>();
  request.count = kVideoBuffers;
  request.memory = V4L2_MEMORY_MMAP;
  if (const int error = file_->control(VIDIOC_REQBUFS, request); error != 0) return error;
  if (request.count == 0) return ENOMEM;
  for (std::uint32_t i = 0; i < request.count; ++i) {
    auto buffer = ofCapture<v4l2_buffer>();
    buffer.index = i;
    buffer.memory = V4L2_MEMORY_MMAP;
    if (const int error = file_->control(VIDIOC_QUERYBUF, buffer); error != 0) return error;
    void* const memory = file_->system().map(file_->descriptor(), buffer.length, buffer.m.offset);
    if (memory == nullptr) return ENOMEM;
    buffers_.push_back({memory, buffer.length});
    if (const int error = file_->control(VIDIOC_QBUF, buffer); error != 0) return error;
  }
  return 0;
}

int VideoStream::start() {
  int type = kCapture;
  const int error = file_->control(VIDIOC_STREAMON, type);
  is_started_ = error == 0;
  return error;
}

tl::expected<std::optional<StreamImage>, int> VideoStream::take() {
  auto buffer = ofCapture<v4l2_buffer>();
  buffer.memory = V4L2_MEMORY_MMAP;
  if (const int error = file_->control(VIDIOC_DQBUF, buffer); error != 0) {
    if (error == EAGAIN) return std::optional<StreamImage>();
    return tl::unexpected(error);
  }
  if (buffer.index >= buffers_.size()) return tl::unexpected(EIO);
  StreamImage taken;
  taken.timestamp_s =
      static_cast<double>(buffer.timestamp.tv_sec) + 1e-6 * static_cast<double>(buffer.timestamp.tv_usec);
  if ((buffer.flags & V4L2_BUF_FLAG_ERROR) == 0)
    taken.image = copyOf(buffers_[buffer.index], buffer.bytesused);
  if (const int error = file_->control(VIDIOC_QBUF, buffer); error != 0) return tl::unexpected(error);
  return std::optional(std::move(taken));
}

/// Empty if the buffer has less than one image.
cv::Mat VideoStream::copyOf(const Mapped& mapped, std::size_t bytes) const {
  const auto rows = static_cast<std::size_t>(size_.height), columns = static_cast<std::size_t>(size_.width);
  const std::size_t needed = (rows - 1) * bytes_per_line_ + kBytesPerPixel * columns;
  if (std::min(bytes, mapped.bytes) < needed) return {};
  return cv::Mat(size_, CV_16UC1, mapped.memory, bytes_per_line_).clone();
}

}  // namespace scantrove
