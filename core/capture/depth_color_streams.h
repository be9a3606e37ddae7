#pragma once
#include <chrono>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/base/result.h"

namespace scantrove {

/// One image of a driver, copied out of its buffers.
struct StreamImage {
  cv::Mat image;           ///< empty: damaged
  double timestamp_s = 0;  ///< by the camera's clock, which both streams share
};

/// The depth and colour streams of one device, each at its own rate. One thread.
class DepthColorStreams {
 public:
  virtual ~DepthColorStreams() = default;

  [[nodiscard]] virtual bool hasColor() const = 0;
  [[nodiscard]] virtual cv::Size colorSize() const = 0;  ///< of the colour images; only with hasColor()

  /// Result of wait(); both empty: timeout.
  struct Arrival {
    std::optional<StreamImage> depth;  ///< CV_16UC1
    std::optional<StreamImage> color;  ///< CV_8UC3, BGR
  };
  /// Waits for the next image of either stream. Error: the device no longer responds; contains the driver's
  /// message.
  [[nodiscard]] virtual Result<Arrival> wait(std::chrono::milliseconds timeout) = 0;
};

}  // namespace scantrove
