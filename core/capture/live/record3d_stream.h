#pragma once
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/capture/camera_info.h"
#include "core/capture/frame_source.h"
#include "core/capture/live/phone_connection.h"
#include "core/capture/live/record3d_message.h"

namespace scantrove {

/// Whether it is "record3d" or "record3d:UDID".
[[nodiscard]] inline bool isRecord3dUri(std::string_view uri) {
  return uri == "record3d" || uri.starts_with("record3d:");
}

/// iPhones and iPads on USB, whether they stream or not. Empty where usbmuxd does not run.
[[nodiscard]] std::vector<CameraInfo> listRecord3dPhones();

/// Opens the stream of Record3D on an iPhone or iPad on USB; "record3d": the first. Waits three seconds at
/// most for its first frame. Frames have their own intrinsics, confidence and, with LiDAR, the device's
/// poses; their time is that of their arrival. Error: no phone, no usbmuxd, or the app does not stream; says
/// what to do. Not yet tested with a phone.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openRecord3dPhone(const std::string& uri,
                                                                     const SourceOptions& options);

/// The frames of a connection. next() waits a second at most (timeout) and returns the newest frame that has
/// arrived; older ones count as dropped. A phone that ends the connection is `failed`. One thread.
class Record3dStream final : public FrameSource {
 public:
  /// Reads the first frame. Error: see openRecord3dPhone().
  [[nodiscard]] static Result<std::unique_ptr<Record3dStream>> start(
      std::unique_ptr<PhoneConnection> connection, const std::string& name, const SourceOptions& options);

  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  [[nodiscard]] FrameRead next() override;

 private:
  using Clock = std::chrono::steady_clock;

  /// The newest message until `deadline`.
  struct Newest {
    std::optional<std::string> message;  ///< none: nothing in time
    int older = 0;                       ///< messages before it
  };

  Record3dStream(std::unique_ptr<PhoneConnection> connection, const SourceOptions& options)
      : connection_(std::move(connection)), options_(options) {}
  [[nodiscard]] Result<void> readFirst(const std::string& name);
  [[nodiscard]] Result<void> setUp(const Record3dFrame& first);
  [[nodiscard]] Result<Newest> receiveNewest(Clock::time_point deadline);
  [[nodiscard]] FrameRead readOne();
  [[nodiscard]] FrameRead frameOf(Record3dFrame decoded, int index, double timestamp_s);
  [[nodiscard]] Intrinsics depthCamera(const Record3dFrame& frame) const;
  [[nodiscard]] bool isSelected(int index) const;
  [[nodiscard]] FrameRead resized(const Record3dFrame& frame) const;
  [[nodiscard]] FrameRead gone(const Error& reason) const;

  std::unique_ptr<PhoneConnection> connection_;
  SourceOptions options_;
  SourceInfo info_;
  std::optional<ColorCamera> color_camera_;
  cv::Size color_size_;
  Record3dMessages messages_;
  Clock::time_point started_ = Clock::now();
  int next_index_ = 0;
};

}  // namespace scantrove
