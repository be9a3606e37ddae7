#pragma once
#include <memory>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/capture/depth_color_streams.h"
#include "core/capture/lens_distortion.h"
#include "core/capture/live/realsense_calibration.h"
#include "core/capture/live/video_nodes.h"
#include "core/capture/live/video_stream.h"

namespace scantrove {

/// The depth (Z16) and colour (YUYV) streams of one RealSense D4xx through the kernel's video nodes. Both
/// have the kernel's monotonic time. One thread.
class RealsenseCamera final : public DepthColorStreams {
 public:
  /// A connected camera.
  struct Device {
    UsbDevice usb;
    std::string model;  ///< "RealSense D435"
    std::vector<VideoNode> nodes;
    std::string depth_node;  ///< "/dev/video0"; empty: the first with depth

    /// "RealSense D435 017322071234"
    [[nodiscard]] std::string name() const;
  };

  /// Opens the nodes and sets 640x480 (else 848x480, else what the camera proposes) at 30 images per second,
  /// without starting. A camera without a colour node gives depth only. Error: no depth node, busy, no
  /// permission; names the node.
  [[nodiscard]] static Result<std::unique_ptr<RealsenseCamera>> open(VideoSystem& system,
                                                                     const Device& device);

  /// What the camera tells of its cameras. Error: it does not answer, or what it says is damaged.
  [[nodiscard]] Result<Intrinsics> depthIntrinsics() const;
  [[nodiscard]] Result<RealsenseColor> colorCamera() const;
  /// Undistorts colour images from now on; they have the pinhole camera `K` then.
  void undistortColor(const LensDistortion& lens, const Intrinsics& K);
  /// Goes on without colour. Before start().
  void dropColor() { color_.reset(); }
  /// Error: names the node.
  [[nodiscard]] Result<void> start();

  [[nodiscard]] cv::Size depthSize() const { return depth_->size(); }
  [[nodiscard]] bool hasColor() const override { return color_ != nullptr; }
  [[nodiscard]] cv::Size colorSize() const override { return color_->size(); }
  [[nodiscard]] Result<Arrival> wait(std::chrono::milliseconds timeout) override;

 private:
  explicit RealsenseCamera(const Device& device) : device_(device) {}
  [[nodiscard]] Result<std::vector<std::uint8_t>> readTable(RealsenseTable table) const;
  [[nodiscard]] int query(std::uint8_t request, std::span<std::uint8_t> data) const;
  [[nodiscard]] Result<void> openNodes(VideoSystem& system);
  [[nodiscard]] Result<std::unique_ptr<VideoStream>> prepare(std::unique_ptr<VideoNodeFile> file,
                                                             const VideoNode& node, std::uint32_t format);
  [[nodiscard]] Error nodeError(const std::string& what, int error, const VideoNode& node) const;
  [[nodiscard]] Result<Arrival> takeReady();
  [[nodiscard]] Result<Arrival> takeLast();

  Device device_;
  VideoNode depth_at_, color_at_;
  std::unique_ptr<VideoStream> depth_, color_;
  std::optional<Undistorter> undistorter_;
};

}  // namespace scantrove
