#pragma once
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/depth_color_streams.h"
#include "core/capture/live/video_system.h"
#include "core/capture/usb_devices.h"

namespace scantrove {

/// Why a call for a video node of `device` failed, and what helps. `what`: the call and the node, without a
/// full stop. `error`: a positive errno.
[[nodiscard]] Error videoError(const std::string& what, int error, const std::filesystem::path& node,
                               const UsbDevice& device);

/// An open video node. One thread.
class VideoNodeFile {
 public:
  /// Result: null and `error` (a positive errno) if it cannot be opened.
  [[nodiscard]] static std::unique_ptr<VideoNodeFile> open(VideoSystem& system,
                                                           const std::filesystem::path& node, int& error);
  VideoNodeFile(const VideoNodeFile&) = delete;
  VideoNodeFile& operator=(const VideoNodeFile&) = delete;
  ~VideoNodeFile() { system_.close(descriptor_); }

  [[nodiscard]] VideoSystem& system() const { return system_; }
  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// An ioctl; 0 or a positive errno.
  template <class Argument>
  [[nodiscard]] int control(unsigned long request, Argument& argument) const {
    return -system_.control(descriptor_, request, &argument);
  }
  /// The pixel formats (V4L2_PIX_FMT_...) of a node for video capture; empty for any other node.
  [[nodiscard]] std::vector<std::uint32_t> formats() const;

 private:
  VideoNodeFile(VideoSystem& system, int descriptor) : system_(system), descriptor_(descriptor) {}

  VideoSystem& system_;
  int descriptor_;
};

/// Images of 16 bits a pixel (depth Z16, colour YUYV) from a video node, through buffers that the kernel
/// maps. One thread.
class VideoStream {
 public:
  /// Format to ask for; of `sizes` the first that the device has, else the size that it proposes.
  struct Request {
    std::uint32_t format = 0;  ///< V4L2_PIX_FMT_...
    std::vector<cv::Size> sizes;
    std::uint32_t frames_per_second = 30;
  };

  /// Sets the format and maps the buffers, without starting. Error: a positive errno; see videoError().
  [[nodiscard]] static tl::expected<std::unique_ptr<VideoStream>, int> prepare(
      std::unique_ptr<VideoNodeFile> file, const Request& request);
  VideoStream(const VideoStream&) = delete;
  VideoStream& operator=(const VideoStream&) = delete;
  ~VideoStream();

  [[nodiscard]] const VideoNodeFile& file() const { return *file_; }
  [[nodiscard]] cv::Size size() const { return size_; }

  /// 0 or a positive errno.
  [[nodiscard]] int start();

  /// The next image, CV_16UC1 with the device's bytes, copied; an incomplete one is empty. None: not ready.
  /// Its time is the kernel's monotonic clock. Error: a positive errno.
  [[nodiscard]] tl::expected<std::optional<StreamImage>, int> take();

 private:
  struct Mapped {
    void* memory = nullptr;
    std::size_t bytes = 0;
  };

  explicit VideoStream(std::unique_ptr<VideoNodeFile> file) : file_(std::move(file)) {}
  [[nodiscard]] int setFormat(const Request& request);
  [[nodiscard]] int mapBuffers();
  [[nodiscard]] cv::Mat copyOf(const Mapped& mapped, std::size_t bytes) const;

  std::unique_ptr<VideoNodeFile> file_;
  cv::Size size_;
  std::size_t bytes_per_line_ = 0;
  std::vector<Mapped> buffers_;
  bool is_started_ = false;
};

}  // namespace scantrove
