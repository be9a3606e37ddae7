#include "core/capture/image_sequence.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/stamped_pose.h"
#include "core/capture/color_registration.h"
#include "core/capture/depth_file.h"
#include "core/capture/depth_plausibility.h"
#include "core/capture/folder_listing.h"
#include "core/capture/pose_files.h"
#include "core/capture/source_options.h"
#include "core/image/image_file.h"
#include "core/image/metric_depth.h"

namespace scantrove {

namespace {

/// Maximum number of unusable frames at the start before the folder is refused.
constexpr std::size_t kProbedFrames = 50;

std::string sizeText(cv::Size size) { return std::to_string(size.width) + "x" + std::to_string(size.height); }

struct Images {
  cv::Mat color, depth, confidence;
};

using ReadFile = Result<cv::Mat> (*)(const std::filesystem::path&);

Result<cv::Mat> decode(const ImageDecoder& decoder, const std::filesystem::path& file, ReadFile read) {
  return decoder ? decoder() : read(file);
}

Result<Images> readImages(const ImageSequenceEntry& entry, const ImageSequence& sequence) {
  const auto missing = [&](const char* what) {
    return "Frame " + std::to_string(entry.index) + " has no " + what + " image.";
  };
  const bool has_color = !entry.color.empty() || entry.decode_color;
  if (entry.depth.empty() && !entry.decode_depth) return fail(missing("depth"));
  if (sequence.has_color && !sequence.is_color_optional && !has_color) return fail(missing("colour"));
  Images images;
  SCANTROVE_TRY(moveInto(images.depth, decode(entry.decode_depth, entry.depth, readAnyDepth)));
  if (sequence.has_color && has_color)
    SCANTROVE_TRY(moveInto(images.color, decode(entry.decode_color, entry.color, readColorImage)));
  if (!entry.confidence.empty() || entry.decode_confidence)
    SCANTROVE_TRY(
        moveInto(images.confidence, decode(entry.decode_confidence, entry.confidence, readGrayImage)));
  if (!images.confidence.empty() && images.confidence.type() != CV_8UC1)
    return fail("The confidence image of frame " + std::to_string(entry.index) +
                " is not 8-bit with 1 channel.");
  return images;
}

/// For messages: the file, or which frame's image.
std::string nameOfImage(const std::filesystem::path& file, const char* what,
                        const ImageSequenceEntry& entry) {
  return file.empty() ? "The " + std::string(what) + " image of frame " + std::to_string(entry.index)
                      : file.string();
}

/// Confidences of a frame from its image, whose values may be those of another range.
cv::Mat confidencesFrom(const cv::Mat& image, const std::array<int, 3>& values) {
  if (image.empty()) return {};
  cv::Mat1b confidences(image.size(), kLowConfidence);
  confidences.setTo(kMediumConfidence, image >= values[kMediumConfidence]);
  confidences.setTo(kHighConfidence, image >= values[kHighConfidence]);
  return confidences;
}

/// Units of a recording's depth images, and of its frames.
struct DepthUnits {
  double file_units_per_meter = 1000;
  bool is_float = false;  ///< CV_32FC1; frames have 16 bits

  [[nodiscard]] float metersPerUnit() const {
    return static_cast<float>(1.0 / (is_float ? kMetricUnitsPerMeter : file_units_per_meter));
  }
  [[nodiscard]] cv::Mat storedDepth(const cv::Mat& depth) const {
    return is_float ? toDepthUnits(depth / file_units_per_meter, metersPerUnit()) : depth;
  }
};

class ImageSequenceSource final : public FrameSource {
 public:
  ImageSequenceSource(ImageSequence sequence, std::vector<std::size_t> selected, SourceInfo info,
                      cv::Size color_size, std::optional<ColorCamera> color_camera, DepthUnits units)
      : sequence_(std::move(sequence)),
        selected_(std::move(selected)),
        info_(std::move(info)),
        color_size_(color_size),
        color_camera_(std::move(color_camera)),
        undistorter_(sequence_.camera.lens
                         ? std::optional(Undistorter(*sequence_.camera.lens, info_.intrinsics))
                         : std::nullopt),
        units_(units) {}

  const SourceInfo& info() const override { return info_; }

  FrameRead next() override {
    FrameRead read;
    if (position_ == selected_.size()) {
      read.status = FrameRead::Status::end;
      return read;
    }
    const ImageSequenceEntry& entry = sequence_.entries[selected_[position_++]];
    read.frame.index = entry.index;
    read.frame.timestamp_s = entry.timestamp_s;
    read.frame.meters_per_unit = units_.metersPerUnit();
    Images images;
    if (const auto problem = readInto(images, read.frame.intrinsics, entry); !problem) {
      std::error_code error;
      const bool is_gone = !std::filesystem::exists(sequence_.folder, error);
      read.status = is_gone ? FrameRead::Status::failed : FrameRead::Status::skipped;
      read.error = is_gone ? Error{sequence_.folder.string() + " is gone.", "Was a drive unplugged?"}
                           : problem.error();
      return read;
    }
    read.status = FrameRead::Status::frame;
    read.frame.color = std::move(images.color);
    read.frame.depth = units_.storedDepth(images.depth);
    read.frame.confidence = confidencesFrom(images.confidence, sequence_.confidences);
    read.frame.T_world_camera = poseOf(entry);
    read.frame.color_camera = color_camera_;
    if (undistorter_) {
      straighten(read.frame);
    } else if (!read.frame.color.empty()) {
      read.frame.color_file = entry.color;
    }
    return read;
  }

 private:
  void straighten(RgbdFrame& frame) const {
    frame.depth = undistorter_->ofDepth(frame.depth);
    if (frame.color.size() == frame.depth.size()) frame.color = undistorter_->ofColor(frame.color);
  }

  /// `K`: the frame's own camera, if it has one.
  Result<void> readInto(Images& images, std::optional<Intrinsics>& K, const ImageSequenceEntry& entry) const {
    SCANTROVE_TRY(moveInto(images, readImages(entry, sequence_)));
    SCANTROVE_TRY(checkSizes(entry, images));
    CameraModel own;
    std::string origin = "frame " + std::to_string(entry.index);
    if (entry.intrinsics) {
      own.K = *entry.intrinsics;
    } else if (!entry.intrinsics_file.empty()) {
      origin = entry.intrinsics_file.string();
      SCANTROVE_TRY(moveInto(own, readIntrinsicsMatrix(entry.intrinsics_file)));
    } else {
      return {};
    }
    K = fitToImages(own, info_.intrinsics.width, info_.intrinsics.height);
    return checkIntrinsics(*K, origin);
  }

  Result<void> checkSizes(const ImageSequenceEntry& entry, const Images& images) const {
    const cv::Size depth_size(info_.intrinsics.width, info_.intrinsics.height);
    if (images.depth.size() != depth_size) {
      return fail(nameOfImage(entry.depth, "depth", entry) + " is " + sizeText(images.depth.size()) +
                  ", the first frame " + sizeText(depth_size) + ".");
    }
    if (units_.is_float != (images.depth.type() == CV_32FC1)) {
      return fail("The depth of frame " + std::to_string(entry.index) + " is " +
                  (units_.is_float ? "16-bit, that of the first frame floating-point."
                                   : "floating-point, that of the first frame 16-bit."));
    }
    if (!images.confidence.empty() && images.confidence.size() != images.depth.size()) {
      return fail("The confidence image of frame " + std::to_string(entry.index) + " is " +
                  sizeText(images.confidence.size()) + ", its depth image " + sizeText(images.depth.size()) +
                  ".");
    }
    if (!images.color.empty() && images.color.size() != color_size_) {
      return fail(nameOfImage(entry.color, "colour", entry) + " is " + sizeText(images.color.size()) +
                  ", the first frame " + sizeText(color_size_) + ".");
    }
    return {};
  }

  static std::optional<Eigen::Isometry3d> poseOf(const ImageSequenceEntry& entry) {
    if (entry.pose_file.empty()) {
      return entry.T_world_camera;
    }
    const auto pose = readPoseFile(entry.pose_file);
    return pose ? std::optional(*pose) : std::nullopt;
  }

  ImageSequence sequence_;
  std::vector<std::size_t> selected_;
  SourceInfo info_;
  cv::Size color_size_;
  std::optional<ColorCamera> color_camera_;
  std::optional<Undistorter> undistorter_;
  DepthUnits units_;
  std::size_t position_ = 0;
};

Result<Images> firstUsable(const ImageSequence& sequence, const std::vector<std::size_t>& selected) {
  std::optional<Error> first_error;
  std::optional<Images> without_color;
  const std::size_t probed = std::min(selected.size(), kProbedFrames);
  for (std::size_t i = 0; i < probed; ++i) {
    auto images = readImages(sequence.entries[selected[i]], sequence);
    if (!images) {
      if (!first_error) first_error = images.error();
    } else if (sequence.has_color && images->color.empty()) {
      without_color = std::move(*images);
    } else {
      return images;
    }
  }
  if (without_color) return *without_color;
  const Error why = first_error.value_or(Error());
  return fail("None of the first " + std::to_string(probed) + " frames of " + sequence.folder.string() +
                  " can be used: " + why.what,
              why.advice);
}

/// The camera of the recording, before the size of the images is known.
void setCamera(ImageSequence& sequence, const ImageSequenceEntry& first, const SourceOptions& options) {
  if (options.intrinsics) {
    if (!isSameCamera(sequence.camera.K, *options.intrinsics))
      sequence.camera.lens.reset();  // it belongs to another camera
    sequence.camera.K = *options.intrinsics;
    sequence.camera.K.width = sequence.camera.K.height = 0;
    sequence.camera_origin = "--intrinsics";
    for (ImageSequenceEntry& entry : sequence.entries) {
      entry.intrinsics.reset();
      entry.intrinsics_file.clear();
    }
  } else if (first.intrinsics) {
    sequence.camera.K = *first.intrinsics;
  }
}

/// Times that no clock gives are replaced by counted ones.
void setPlausibleTimes(ImageSequence& sequence) {
  constexpr double kLatest_s = 1e12;
  const bool is_plausible = std::ranges::all_of(sequence.entries, [](const ImageSequenceEntry& entry) {
    return std::abs(entry.timestamp_s) < kLatest_s;  // false for NaN
  });
  if (is_plausible) return;
  spdlog::warn("{}: some of its times are no times; counting 30 frames a second instead.",
               folderName(sequence.folder));
  for (ImageSequenceEntry& entry : sequence.entries) entry.timestamp_s = entry.index / kFrameRateHz;
}

}  // namespace

Result<std::unique_ptr<FrameSource>> openImageSequence(ImageSequence sequence, const SourceOptions& options) {
  SCANTROVE_TRY(checkSourceOptions(options));
  auto selected = selectFrames(sequence.entries.size(), options, sequence.folder.string());
  if (!selected) {
    return fail(selected.error());
  }
  setPlausibleTimes(sequence);
  sequence.is_color_optional = sequence.is_color_optional || sequence.camera.is_color_optional;
  const auto first = firstUsable(sequence, *selected);
  if (!first) {
    return fail(first.error());
  }
  const cv::Size size = first->depth.size();
  if (first->color.empty()) sequence.has_color = false;
  const cv::Size color_size = sequence.has_color ? first->color.size() : size;
  setCamera(sequence, sequence.entries[selected->front()], options);
  SourceInfo info;
  info.name = folderName(sequence.folder);
  info.kind = sequence.kind;
  info.intrinsics = fitToImages(sequence.camera, size.width, size.height);
  info.frame_count = static_cast<int>(selected->size());
  info.is_color_optional = sequence.has_color && sequence.is_color_optional;
  info.has_poses = sequence.has_poses;
  info.pose_origin = sequence.pose_origin;
  SCANTROVE_TRY(checkIntrinsics(info.intrinsics, sequence.camera_origin));
  std::optional<ColorCamera> color_camera;
  if (sequence.has_color) {
    const ColorRegistration color =
        options.color_registration.value_or(sequence.camera.color.value_or(sequence.color));
    SCANTROVE_TRY(
        moveInto(color_camera, colorCameraFor(color, color_size, info.intrinsics, sequence.folder.string())));
  }

  // A scale in a camera file is that of 16-bit images; floating-point depth is in metres.
  const bool is_float = first->depth.type() == CV_32FC1;
  const DepthUnits units{
      options.depth_scale.value_or(
          is_float ? 1 : sequence.camera.units_per_meter.value_or(sequence.units_per_meter)),
      is_float};
  SCANTROVE_TRY(checkDepthScale(units.file_units_per_meter,
                                options.depth_scale ? "--depth-scale" : sequence.camera_origin));
  info.implausible_depth = warnOfImplausibleDepth(first->depth, units.file_units_per_meter, info.name);
  return std::make_unique<ImageSequenceSource>(std::move(sequence), std::move(*selected), std::move(info),
                                               color_size, std::move(color_camera), units);
}

}  // namespace scantrove
