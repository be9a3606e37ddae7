#include "core/scan/scan_advisor.h"

#include <cmath>
#include <opencv2/core.hpp>
#include <sstream>
#include <utility>

namespace scantrove {
namespace {

/// Maximum fraction of the image with surface that is too far away.
constexpr double kMax = 0.5;
/// Frames after which it is decided whether most of the surface is too far away.
constexpr int kFramesToJudge = 20;

std::string meters(double value) {
  std::ostringstream text;
  text.precision(3);
  text << value << " m";
  return text.str();
}

/// Pixels with readings beyond `depth_m`, as a fraction of the image.
double shareBeyond(const RgbdFrame& frame, double depth_m) {
  if (frame.depth.empty()) return 0;
  const cv::Mat beyond = frame.depth > depth_m / static_cast<double>(frame.meters_per_unit);
  return static_cast<double>(cv::countNonZero(beyond)) / static_cast<double>(frame.depth.total());
}

std::optional<Error> adviceOnDevice(const FrameCounts& frames) {
  if (frames.by_device <= frames.tracked / 2) return std::nullopt;
  return Error{"Of " + std::to_string(frames.tracked) + " frames in the map " +
                   std::to_string(frames.by_device) +
                   " follow the device's own poses alone, because its depth did not confirm them.",
               "Look whether surfaces are double. If so, scan more slowly, or try --poses tracked."};
}

}  // namespace

std::optional<Error> ScanAdvisor::addFrame(const RgbdFrame& frame, bool is_usable) {
  usable_ += is_usable ? 1 : 0;
  lost_in_a_row_ = is_usable ? 0 : lost_in_a_row_ + 1;
  return adviceOnDepth(frame);
}

std::optional<Error> ScanAdvisor::adviceOnDepth(const RgbdFrame& frame) {
  if (judged_frames_ >= kFramesToJudge) return std::nullopt;
  ++judged_frames_;
  const double share = shareBeyond(frame, static_cast<double>(max_depth_m_));
  far_ += share > kMax ? 1 : 0;
  far_share_ += share > kMax ? share : 0;
  if (judged_frames_ < kFramesToJudge || far_ <= kFramesToJudge / 2) return std::nullopt;
  const long percent = std::lround(100 * far_share_ / far_);
  return Error{"Of most images about " + std::to_string(percent) + " % is farther away than " +
                   meters(static_cast<double>(max_depth_m_)) + " and is left out.",
               "Go nearer, or set fusion.max_depth_m higher (--set fusion.max_depth_m=...); if nothing is "
               "that far away, the depth scale is wrong (--depth-scale)."};
}

Error ScanAdvisor::restart(int frame_index) {
  const int dropped = std::exchange(usable_, 0);
  lost_in_a_row_ = 0;
  return {"The camera was lost after the first " +
              (dropped == 1 ? std::string("frame") : std::to_string(dropped) + " frames") +
              " and not found again for a second: the map begins anew after frame " +
              std::to_string(frame_index) + ".",
          "What the frames before showed is left out; --start leaves out bad ones at once."};
}

std::optional<Error> ScanAdvisor::adviceOn(const FrameCounts& frames) {
  const int without = frames.lost + frames.skipped;
  if (frames.tracked == 0) return std::nullopt;
  if (without <= frames.tracked) return adviceOnDevice(frames);
  return Error{
      "Of " + std::to_string(frames.done()) + " frames only " + std::to_string(frames.tracked) +
          " are in the map: the camera was lost in " + std::to_string(frames.lost) +
          (frames.skipped > 0 ? ", and " + std::to_string(frames.skipped) + " could not be used" : "") + ".",
      "Scan more slowly, with more that stands out in view, or leave out what is bad with --start and "
      "--frames."};
}

}  // namespace scantrove
