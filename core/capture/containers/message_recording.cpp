#include "core/capture/containers/message_recording.h"

#include <spdlog/spdlog.h>

#include <cmath>
#include <cstdlib>

#include "core/capture/containers/nearest_in_time.h"
#include "core/capture/containers/realsense_recording.h"
#include "core/capture/containers/ros_cameras.h"
#include "core/capture/containers/ros_images.h"
#include "core/capture/containers/topic_choice.h"
#include "core/capture/folder_listing.h"
#include "core/image/metric_depth.h"

namespace scantrove {

namespace {

constexpr std::int64_t kUnreadStamp = -1;
constexpr double kRosUnitsPerMeter = 1000;  // 16UC1 and mono16 are millimetres

std::vector<std::int64_t> recordTimes(const MessageTopic& topic) {
  std::vector<std::int64_t> times;
  times.reserve(topic.messages.size());
  for (const MessageEntry& entry : topic.messages) times.push_back(entry.time_ns);
  return times;
}

class MessageRecording final : public ContainerImages {
 public:
  MessageRecording(std::unique_ptr<MessageFile> file, ChosenTopics topics, std::string kind)
      : file_(std::move(file)),
        topics_(std::move(topics)),
        kind_(std::move(kind)),
        depth_times_(recordTimes(*topics_.depth)) {
    if (topics_.color == nullptr) return;
    color_times_ = recordTimes(*topics_.color);
    color_stamps_.assign(color_times_.size(), kUnreadStamp);
    tolerance_ns_ = pairTolerance(depth_times_, color_times_);
    has_common_clock_ = haveCommonClock();
  }

  [[nodiscard]] std::string kind() const override { return kind_; }
  [[nodiscard]] std::size_t count() const override { return depth_times_.size(); }
  [[nodiscard]] bool hasColor() const override { return topics_.color != nullptr; }

  [[nodiscard]] Result<ContainerCameras> cameras(const cv::Size& /*depth*/,
                                                 const cv::Size& /*color*/) override {
    ContainerCameras cameras;
    cameras.depth.units_per_meter = unitsPerMeter();
    const std::optional<RosCamera> depth = cameraOf(*topics_.depth);
    const std::optional<RosCamera> color = hasColor() ? cameraOf(*topics_.color) : std::nullopt;
    if (depth) {
      cameras.depth.K = depth->K;
      cameras.depth.lens = depth->lens;
    }
    if (!hasColor()) return cameras;
    if (color) cameras.color_lens = color->lens;
    if (isRegistered()) {
      if (!depth && color) {
        cameras.depth.K = color->K;
        cameras.depth.lens = color->lens;
      }
      return cameras;
    }
    const auto T_color_depth = colorPlace();
    cameras.is_color_place_known = T_color_depth && color;
    if (cameras.is_color_place_known) cameras.color = ColorCamera{color->K, *T_color_depth};
    return cameras;
  }

  [[nodiscard]] Result<ContainerFrame> read(std::size_t position) override {
    const MessageEntry& entry = topics_.depth->messages[position];
    const Result<ByteBlock> message = file_->read(entry);
    if (!message) return fail(message.error());
    ContainerFrame frame;
    const std::string name = "Image " + std::to_string(position) + " of " + topics_.depth->name;
    SCANTROVE_TRY(moveInto(frame.depth, decodeRosDepth(*message, *topics_.depth, name)));
    const auto header = decodeRosHeader(*message, topics_.depth->encoding);
    const std::int64_t stamp = header && header->stamp_ns > 0 ? header->stamp_ns : entry.time_ns;
    frame.timestamp_s = static_cast<double>(stamp) * 1e-9;
    if (const auto color = hasColor() ? colorAt(stamp, entry.time_ns) : std::nullopt)
      SCANTROVE_TRY(moveInto(frame.color, readColor(*color)));
    return frame;
  }

 private:
  [[nodiscard]] std::optional<RosCamera> cameraOf(const MessageTopic& topic) {
    const MessageTopic* const info = cameraInfoOf(*file_, topic.name);
    return info == nullptr ? std::nullopt : readRosCamera(*file_, *info, topic.name);
  }

  [[nodiscard]] double unitsPerMeter() {
    if (topics_.depth_kind.is_metric) return kMetricUnitsPerMeter;
    if (!isRealsenseTopic(topics_.depth->name)) return kRosUnitsPerMeter;
    if (const auto unit = realsenseDepthUnit(*file_, topics_.depth->name)) return 1 / *unit;
    spdlog::warn("{}: the depth unit is not in the file; using millimetres. Else give --depth-scale.",
                 file_->path().string());
    return kRosUnitsPerMeter;
  }

  /// Whether the images say that they are of one camera.
  [[nodiscard]] bool isRegistered() const {
    if (isRealsenseTopic(topics_.depth->name)) return false;
    const std::string depth = lowerCase(topics_.depth->name);
    const std::string frame = rosFrameName(topics_.depth_kind.header.frame);
    return depth.find("aligned_depth_to_color") != std::string::npos ||
           depth.find("depth_registered") != std::string::npos ||
           (!frame.empty() && frame == rosFrameName(topics_.color_kind.header.frame));
  }

  [[nodiscard]] std::optional<Eigen::Isometry3d> colorPlace() {
    if (isRealsenseTopic(topics_.depth->name) && isRealsenseTopic(topics_.color->name))
      return realsenseColorPlace(*file_, topics_.depth->name, topics_.color->name);
    return readRosTransform(*file_, topics_.color_kind.header.frame, topics_.depth_kind.header.frame);
  }

  /// Whether both streams have stamps of one clock, which must differ from the time of recording alike.
  [[nodiscard]] bool haveCommonClock() {
    constexpr std::int64_t kMostDifference_ns = 1'000'000'000;
    const std::int64_t depth = topics_.depth_kind.header.stamp_ns;
    const std::int64_t color = topics_.color_kind.header.stamp_ns;
    if (depth <= 0 || color <= 0) return false;
    const std::int64_t between_stamps = depth - color;
    const double between_records =
        static_cast<double>(depth_times_.front()) - static_cast<double>(color_times_.front());
    return std::abs(static_cast<double>(between_stamps) - between_records) < kMostDifference_ns;
  }

  /// The stamp of a colour image, by the clock of the depth images. Reads the start of its message once.
  [[nodiscard]] std::int64_t colorStamp(std::size_t position) {
    std::int64_t& stamp = color_stamps_[position];
    if (stamp != kUnreadStamp) return stamp;
    const Result<ByteBlock> start = file_->read(topics_.color->messages[position], kRosStartBytes);
    const auto header = start ? decodeRosHeader(*start, topics_.color->encoding) : std::nullopt;
    stamp = header && header->stamp_ns > 0 ? header->stamp_ns : 0;
    return stamp;
  }

  /// The colour image nearest to a depth image. Streams arrive late by different times, so that images
  /// recorded somewhat before and after are compared by their stamps.
  [[nodiscard]] std::optional<std::size_t> colorAt(std::int64_t depth_stamp, std::int64_t depth_record) {
    constexpr std::size_t kAround = 5;
    const std::size_t nearest = nearestTime(color_times_, depth_record);
    const auto distanceTo = [&](std::size_t i) {
      return has_common_clock_ ? std::abs(colorStamp(i) - depth_stamp)
                               : std::abs(color_times_[i] - depth_record);
    };
    std::optional<std::size_t> best;
    std::int64_t least = tolerance_ns_;
    const std::size_t first = nearest > kAround ? nearest - kAround : 0;
    for (std::size_t i = first; i < std::min(nearest + kAround + 1, color_times_.size()); ++i) {
      const std::int64_t distance = distanceTo(i);
      if (distance > least || (best && distance == least)) continue;
      least = distance;
      best = i;
    }
    return best;
  }

  [[nodiscard]] Result<cv::Mat> readColor(std::size_t position) {
    if (color_position_ == position) return color_;  // streams may differ in rate
    const Result<ByteBlock> message = file_->read(topics_.color->messages[position]);
    if (!message) return fail(message.error());
    const std::string name = "Image " + std::to_string(position) + " of " + topics_.color->name;
    Result<cv::Mat> color = decodeRosColor(*message, *topics_.color, name);
    if (color) {
      color_ = *color;
      color_position_ = position;
    }
    return color;
  }

  std::unique_ptr<MessageFile> file_;
  ChosenTopics topics_;
  std::string kind_;
  std::vector<std::int64_t> depth_times_, color_times_;  // of recording
  std::vector<std::int64_t> color_stamps_;               // of the camera; kUnreadStamp: not yet known
  std::int64_t tolerance_ns_ = 0;
  bool has_common_clock_ = false;
  cv::Mat color_;  // the last one
  std::optional<std::size_t> color_position_;
};

}  // namespace

Result<std::unique_ptr<ContainerImages>> openMessageRecording(std::unique_ptr<MessageFile> file,
                                                              const std::string& kind,
                                                              const SourceOptions& options) {
  Result<ChosenTopics> topics = chooseTopics(*file, options);
  if (!topics) return fail(topics.error());
  const bool is_realsense = isRealsenseTopic(topics->depth->name);
  return std::make_unique<MessageRecording>(std::move(file), std::move(*topics),
                                            is_realsense ? "RealSense recording" : kind);
}

}  // namespace scantrove
