#pragma once
#include <chrono>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/base/result.h"

namespace scantrove {

/// One image as a driver gave it, copied out of its buffers.
struct StreamImage {
  cv::Mat image;           ///< empty: damaged
  double timestamp_s = 0;  ///< by the camera's clock, the same for both streams
};

/// The depth and colour streams of one device, each at a pace of its own. One thread.
class DepthColorStreams {
 public:
  virtual ~DepthColorStreams() = default;

  [[nodiscard]] virtual bool hasColor() const = 0;
  [[nodiscard]] virtual cv::Size colorSize() const = 0;  ///< of the colour images; only with hasColor()

  /// What wait() gave; nothing: the time is over.
  struct Arrival {
    std::optional<StreamImage> depth;  ///< CV_16UC1
    std::optional<StreamImage> color;  ///< CV_8UC3, BGR
  };
  /// Waits for the next image of either stream. Error: the device does not answer any more; the driver's
  /// words.
  [[nodiscard]] virtual Result<Arrival> wait(std::chrono::milliseconds timeout) = 0;
};

}  // namespace scantrove
