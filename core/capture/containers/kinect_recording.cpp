#include "core/capture/containers/kinect_recording.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/capture/containers/kinect_calibration.h"
#include "core/capture/containers/nearest_in_time.h"
#include "core/capture/folder_listing.h"
#include "core/image/image_file.h"
#include "core/image/image_header.h"

namespace scantrove {

namespace {

constexpr const char* kDepthCodec = "b16g";

std::vector<std::int64_t> blockTimes(const MatroskaTrack& track) {
  std::vector<std::int64_t> times;
  times.reserve(track.blocks.size());
  for (const MatroskaBlock& block : track.blocks) times.push_back(block.time_ns);
  return times;
}

bool isColorCodec(const std::string& codec) {
  return codec == "MJPG" || codec == "NV12" || codec == "YUY2" || codec == "BGRA" || codec == "ARGB";
}

/// The infrared track has the same format: the names tell them apart, else depth comes first.
const MatroskaTrack* depthTrackOf(const MatroskaFile& file) {
  const MatroskaTrack* depth = nullptr;
  for (const MatroskaTrack& track : file.tracks()) {
    if (track.codec != kDepthCodec || track.blocks.empty()) continue;
    const std::string name = lowerCase(track.name);
    if (name.starts_with("depth")) return &track;
    if (depth == nullptr && !name.starts_with("ir")) depth = &track;
  }
  return depth;
}

const MatroskaTrack* colorTrackOf(const MatroskaFile& file) {
  const auto found = std::ranges::find_if(file.tracks(), [](const MatroskaTrack& track) {
    return isColorCodec(track.codec) && !track.blocks.empty();
  });
  return found == file.tracks().end() ? nullptr : &*found;
}

/// Big-endian pixels; 65535 becomes 0.
Result<cv::Mat> depthFromBigEndian(ByteView bytes, const MatroskaTrack& track, const std::string& name) {
  const auto width = static_cast<std::uint32_t>(track.width),
             height = static_cast<std::uint32_t>(track.height);
  SCANTROVE_TRY(checkImageSize({width, height}, name));
  if (bytes.size() != std::size_t{2} * width * height) return fail(name + " is damaged.");
  cv::Mat depth(track.height, track.width, CV_16UC1);
  auto* const values = depth.ptr<std::uint16_t>();
  for (std::size_t i = 0; i < depth.total(); ++i) {
    const auto value = static_cast<std::uint16_t>(bytes[2 * i] << 8 | bytes[2 * i + 1]);
    values[i] = value == UINT16_MAX ? std::uint16_t{0} : value;
  }
  return depth;
}

Result<cv::Mat> colorFromPixels(ByteView bytes, const MatroskaTrack& track, const std::string& name) {
  if (track.codec == "MJPG") return decodeColorImage(bytes, name);
  const auto width = static_cast<std::uint32_t>(track.width),
             height = static_cast<std::uint32_t>(track.height);
  SCANTROVE_TRY(checkImageSize({width, height}, name));
  const bool is_nv12 = track.codec == "NV12", is_yuy2 = track.codec == "YUY2";
  const std::size_t pixels = std::size_t{width} * height;
  const std::size_t needed = is_nv12 ? pixels / 2 * 3 : is_yuy2 ? pixels * 2 : pixels * 4;
  if (bytes.size() != needed || width % 2 != 0 || height % 2 != 0) return fail(name + " is damaged.");
  auto* const data = const_cast<std::uint8_t*>(bytes.data());  // only read
  const cv::Mat image(is_nv12 ? track.height / 2 * 3 : track.height, track.width,
                      is_nv12   ? CV_8UC1
                      : is_yuy2 ? CV_8UC2
                                : CV_8UC4,
                      data);
  cv::Mat color;
  cv::cvtColor(image, color,
               is_nv12   ? cv::COLOR_YUV2BGR_NV12
               : is_yuy2 ? cv::COLOR_YUV2BGR_YUY2
                         : cv::COLOR_BGRA2BGR);
  return color;
}

class KinectRecording final : public ContainerImages {
 public:
  KinectRecording(std::unique_ptr<MatroskaFile> file, const MatroskaTrack& depth, const MatroskaTrack* color)
      : file_(std::move(file)), depth_(depth), color_(color) {
    if (color_ == nullptr) return;
    color_times_ = blockTimes(*color_);
    tolerance_ns_ = pairTolerance(blockTimes(depth_), color_times_);
  }

  [[nodiscard]] std::string kind() const override { return "Azure Kinect recording"; }
  [[nodiscard]] std::size_t count() const override { return depth_.blocks.size(); }
  [[nodiscard]] bool hasColor() const override { return color_ != nullptr; }

  [[nodiscard]] Result<ContainerCameras> cameras(const cv::Size& depth, const cv::Size& color) override {
    const auto calibration = file_->attachments().find("calibration.json");
    if (calibration != file_->attachments().end())
      return kinectCameras(calibration->second, depth, color, file_->path().string());
    ContainerCameras cameras;
    cameras.depth.units_per_meter = 1000;  // millimetres
    cameras.is_color_place_known = false;
    return cameras;
  }

  [[nodiscard]] Result<ContainerFrame> read(std::size_t position) override {
    const MatroskaBlock& block = depth_.blocks[position];
    ContainerFrame frame;
    frame.timestamp_s = static_cast<double>(block.time_ns) * 1e-9;
    const Result<ByteBlock> depth = file_->read(block);
    if (!depth) return fail(depth.error());
    const std::string image = "image " + std::to_string(position) + " of " + file_->path().string();
    SCANTROVE_TRY(moveInto(frame.depth, depthFromBigEndian(*depth, depth_, "Depth " + image)));
    if (color_ == nullptr) return frame;
    const MatroskaBlock& nearest = color_->blocks[nearestTime(color_times_, block.time_ns)];
    if (std::abs(nearest.time_ns - block.time_ns) > tolerance_ns_) return frame;
    const Result<ByteBlock> color = file_->read(nearest);
    if (!color) return fail(color.error());
    SCANTROVE_TRY(moveInto(frame.color, colorFromPixels(*color, *color_, "Colour " + image)));
    return frame;
  }

 private:
  std::unique_ptr<MatroskaFile> file_;
  const MatroskaTrack& depth_;  // of the file
  const MatroskaTrack* color_;  // of the file; null: none
  std::vector<std::int64_t> color_times_;
  std::int64_t tolerance_ns_ = 0;
};

}  // namespace

Result<std::unique_ptr<ContainerImages>> openKinectRecording(std::unique_ptr<MatroskaFile> file) {
  const MatroskaTrack* const depth = depthTrackOf(*file);
  if (depth == nullptr) {
    return fail(file->path().string() + " is a video without the depth of an Azure Kinect or Orbbec Femto.",
                "Record with k4arecorder, with depth.");
  }
  const MatroskaTrack* const color = colorTrackOf(*file);
  return std::make_unique<KinectRecording>(std::move(file), *depth, color);
}

}  // namespace scantrove
