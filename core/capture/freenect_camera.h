#pragma once
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <utility>

#include "core/base/result.h"
#include "core/capture/depth_color_streams.h"
#include "core/capture/freenect_api.h"
#include "core/capture/freenect_clock.h"
#include "core/capture/intrinsics.h"

namespace scantrove {

/// Selects a Kinect v1 by index among the connected ones, or by serial number.
struct FreenectChoice {
  int index = 0;
  std::string serial;  ///< of its camera; empty: by index

  /// "Kinect 0", "Kinect A00362A17284043A"
  [[nodiscard]] std::string name() const;
};

/// A libfreenect context, which counts and opens cameras. One thread.
class FreenectContext {
 public:
  /// Error: libfreenect's message.
  [[nodiscard]] static Result<std::unique_ptr<FreenectContext>> create(const FreenectApi& api);
  FreenectContext(const FreenectContext&) = delete;
  FreenectContext& operator=(const FreenectContext&) = delete;
  ~FreenectContext();

  [[nodiscard]] const FreenectApi& api() const { return api_; }
  [[nodiscard]] freenect_context* get() const { return context_; }
  /// Connected cameras, including those without permission to open.
  [[nodiscard]] int count() const;

 private:
  explicit FreenectContext(const FreenectApi& api) : api_(api) {}

  const FreenectApi& api_;
  freenect_context* context_ = nullptr;
};

/// Images that libfreenect delivered and wait() has not returned yet.
struct FreenectReceived {
  struct Image {
    bool is_depth = false;
    cv::Mat image;
    std::uint32_t ticks = 0;  ///< see FreenectClock
  };
  std::deque<Image> images;
};

/// The started depth (mm; 0 = no reading) and colour streams of one Kinect v1, 640x480 at 30 Hz. libfreenect
/// has no thread and works only inside wait(), so call wait() continuously. One thread at a time.
class FreenectCamera final : public DepthColorStreams {
 public:
  static constexpr int kWidth = 640;
  static constexpr int kHeight = 480;

  /// Opens and starts. `is_registered`: depth from the colour camera's viewpoint, else from the depth
  /// camera's. Error: no camera, not the selected one, no permission, or no such image format; names it.
  [[nodiscard]] static Result<std::unique_ptr<FreenectCamera>> open(const FreenectApi& api,
                                                                    const FreenectChoice& choice,
                                                                    bool is_registered);
  FreenectCamera(const FreenectCamera&) = delete;
  FreenectCamera& operator=(const FreenectCamera&) = delete;
  ~FreenectCamera() override;

  [[nodiscard]] bool hasColor() const override { return true; }
  [[nodiscard]] cv::Size colorSize() const override { return {kWidth, kHeight}; }
  [[nodiscard]] Result<Arrival> wait(std::chrono::milliseconds timeout) override;

  /// Nominal intrinsics; a Kinect v1 does not report its own.
  [[nodiscard]] Intrinsics intrinsics() const;

 private:
  FreenectCamera(std::unique_ptr<FreenectContext> context, bool is_registered)
      : context_(std::move(context)), is_registered_(is_registered) {}
  [[nodiscard]] Result<void> openDevice(const FreenectChoice& choice);
  [[nodiscard]] Result<void> start(const std::string& name);
  [[nodiscard]] const FreenectApi& api() const { return context_->api(); }
  [[nodiscard]] Arrival nextReceived();

  std::unique_ptr<FreenectContext> context_;
  bool is_registered_;
  freenect_device* device_ = nullptr;
  bool is_started_ = false;
  FreenectReceived received_;
  FreenectClock clock_;
};

}  // namespace scantrove
