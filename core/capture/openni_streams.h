#pragma once
#include <OpenNI.h>

#include <chrono>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/capture/intrinsics.h"

namespace scantrove {

/// One image as OpenNI2 gave it, copied out of its buffers.
struct OpenNiImage {
  cv::Mat image;
  double timestamp_s = 0;
};

/// The depth and colour streams of one OpenNI2 device (camera or .oni file), started. One thread.
class OpenNiStreams {
 public:
  OpenNiStreams() = default;
  OpenNiStreams(const OpenNiStreams&) = delete;
  OpenNiStreams& operator=(const OpenNiStreams&) = delete;
  ~OpenNiStreams();

  /// Opens and starts the device `uri`. A camera is set to 640x480 where it can, and registers depth to
  /// colour if it is to and can. Error: OpenNI2's words.
  [[nodiscard]] Result<void> open(const std::string& uri, bool is_to_register);

  [[nodiscard]] bool isRecording() const { return handles_->device.isFile(); }
  [[nodiscard]] std::string name() const { return handles_->device.getDeviceInfo().getName(); }
  [[nodiscard]] bool hasColor() const { return handles_->color.isValid(); }
  [[nodiscard]] int depthFrameCount();  ///< of a recording; 0 if it does not say
  [[nodiscard]] double metresPerUnit() const;
  /// From the field of view and the depth stream's size; empty if the device does not say.
  [[nodiscard]] std::optional<Intrinsics> intrinsics() const;
  [[nodiscard]] cv::Size size() const;       ///< of the depth images
  [[nodiscard]] cv::Size colorSize() const;  ///< of the colour images; only with hasColor()

  /// What wait() gave: one of both, or nothing in time.
  struct Arrival {
    std::optional<OpenNiImage> depth;  ///< CV_16UC1
    std::optional<OpenNiImage> color;  ///< CV_8UC3, BGR
  };
  /// Waits for the next image of either stream. Error: the device does not answer any more.
  [[nodiscard]] Result<Arrival> wait(std::chrono::milliseconds timeout);

 private:
  void configureCamera(bool is_to_register);

  /// OpenNI2's own objects, apart so that they can outlive this one (see the destructor).
  struct Handles {
    openni::Device device;
    openni::VideoStream depth, color;
    Handles* kept_before = nullptr;
  };
  std::unique_ptr<Handles> handles_ = std::make_unique<Handles>();
  bool is_depth_mirrored_ = false;  // recordings only: a camera is told not to mirror
  bool is_color_mirrored_ = false;
};

}  // namespace scantrove
