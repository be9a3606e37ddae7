#pragma once
#include <OpenNI.h>

#include <chrono>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/capture/depth_color_streams.h"
#include "core/capture/intrinsics.h"

namespace scantrove {

/// The started depth and colour streams of one OpenNI2 device (camera or .oni file). One thread.
class OpenNiStreams final : public DepthColorStreams {
 public:
  OpenNiStreams() = default;
  OpenNiStreams(const OpenNiStreams&) = delete;
  OpenNiStreams& operator=(const OpenNiStreams&) = delete;
  ~OpenNiStreams() override;

  /// Opens and starts the device `uri`. Sets a camera to 640x480 where it can, and registers depth to colour
  /// if requested and supported. Error: OpenNI2's message.
  [[nodiscard]] Result<void> open(const std::string& uri, bool is_to_register);

  [[nodiscard]] bool isRecording() const { return handles_->device.isFile(); }
  [[nodiscard]] std::string name() const { return handles_->device.getDeviceInfo().getName(); }
  [[nodiscard]] bool hasColor() const override { return handles_->color.isValid(); }
  [[nodiscard]] int depthFrameCount();  ///< of a recording; 0 if unknown
  [[nodiscard]] double metersPerUnit() const;
  /// From the field of view and the depth stream's size; empty if the device does not report it.
  [[nodiscard]] std::optional<Intrinsics> intrinsics() const;
  [[nodiscard]] cv::Size size() const;  ///< of the depth images
  [[nodiscard]] cv::Size colorSize() const override;

  [[nodiscard]] Result<Arrival> wait(std::chrono::milliseconds timeout) override;

 private:
  void configureCamera(bool is_to_register);

  /// OpenNI2's objects, separate because they may outlive this object (see the destructor).
  struct Handles {
    openni::Device device;
    openni::VideoStream depth, color;
    Handles* kept_before = nullptr;
  };
  std::unique_ptr<Handles> handles_ = std::make_unique<Handles>();
  bool is_depth_mirrored_ = false;  // recordings only; cameras are set not to mirror
  bool is_color_mirrored_ = false;
};

}  // namespace scantrove
