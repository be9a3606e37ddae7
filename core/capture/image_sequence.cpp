#include "core/capture/image_sequence.h"

#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/capture/depth_plausibility.h"
#include "core/capture/folder_listing.h"
#include "core/capture/image_file.h"
#include "core/capture/pose_files.h"
#include "core/capture/source_options.h"

namespace scantrove {

namespace {

/// How many frames may be unusable at the start before the folder is refused.
constexpr std::size_t kProbedFrames = 50;

std::string sizeText(cv::Size size) { return std::to_string(size.width) + "x" + std::to_string(size.height); }

struct Images {
  cv::Mat color, depth;
};

Result<Images> readImages(const ImageSequenceEntry& entry, bool has_color) {
  const auto missing = [&](const char* what) {
    return "Frame " + std::to_string(entry.index) + " has no " + what + " image.";
  };
  if (entry.depth.empty()) {
    return fail(missing("depth"));
  }
  if (has_color && entry.color.empty()) {
    return fail(missing("colour"));
  }
  Images images;
  if (auto depth = readDepthImage(entry.depth)) {
    images.depth = std::move(*depth);
  } else {
    return fail(depth.error());
  }
  if (has_color) {
    if (auto color = readColorImage(entry.color)) {
      images.color = std::move(*color);
    } else {
      return fail(color.error());
    }
  }
  return images;
}

class ImageSequenceSource final : public FrameSource {
 public:
  ImageSequenceSource(ImageSequence sequence, std::vector<std::size_t> selected, SourceInfo info,
                      cv::Size color_size, double metres_per_unit)
      : sequence_(std::move(sequence)),
        selected_(std::move(selected)),
        info_(std::move(info)),
        color_size_(color_size),
        metres_per_unit_(static_cast<float>(metres_per_unit)) {}

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
    read.frame.metres_per_unit = metres_per_unit_;
    auto images = readImages(entry, sequence_.has_color);
    if (const auto problem = images ? checkSizes(entry, *images) : tl::unexpected(images.error()); !problem) {
      std::error_code error;
      const bool is_gone = !std::filesystem::is_directory(sequence_.folder, error);
      read.status = is_gone ? FrameRead::Status::failed : FrameRead::Status::skipped;
      read.error =
          is_gone ? Error{"The folder " + sequence_.folder.string() + " is gone.", "Was a drive unplugged?"}
                  : problem.error();
      return read;
    }
    const cv::Size frame_size(info_.intrinsics.width, info_.intrinsics.height);
    if (sequence_.has_color && sequence_.color_camera) {
      images->color = registerColor(images->color, *sequence_.color_camera, images->depth, metres_per_unit_,
                                    info_.intrinsics);
    } else if (sequence_.has_color && images->color.size() != frame_size) {
      cv::Mat resized;
      cv::resize(images->color, resized, frame_size, 0, 0, cv::INTER_AREA);
      images->color = resized;
    }
    read.status = FrameRead::Status::frame;
    read.frame.color = std::move(images->color);
    read.frame.depth = std::move(images->depth);
    read.frame.T_world_camera = poseOf(entry);
    return read;
  }

 private:
  Result<void> checkSizes(const ImageSequenceEntry& entry, const Images& images) const {
    const cv::Size depth_size(info_.intrinsics.width, info_.intrinsics.height);
    if (images.depth.size() != depth_size) {
      return fail(entry.depth.string() + " is " + sizeText(images.depth.size()) + ", the first frame " +
                  sizeText(depth_size) + ".");
    }
    if (sequence_.has_color && images.color.size() != color_size_) {
      return fail(entry.color.string() + " is " + sizeText(images.color.size()) + ", the first frame " +
                  sizeText(color_size_) + ".");
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
  float metres_per_unit_;
  std::size_t position_ = 0;
};

Result<Images> firstUsable(const ImageSequence& sequence, const std::vector<std::size_t>& selected) {
  std::optional<Error> first_error;
  const std::size_t probed = std::min(selected.size(), kProbedFrames);
  for (std::size_t i = 0; i < probed; ++i) {
    auto images = readImages(sequence.entries[selected[i]], sequence.has_color);
    if (images) {
      return images;
    }
    if (!first_error) {
      first_error = images.error();
    }
  }
  return fail("None of the first " + std::to_string(probed) + " frames of " + sequence.folder.string() +
                  " can be used: " + first_error->what,
              first_error->advice);
}

}  // namespace

Result<std::unique_ptr<FrameSource>> openImageSequence(ImageSequence sequence, const SourceOptions& options) {
  SCANTROVE_TRY(checkSourceOptions(options));
  auto selected = selectFrames(sequence.entries.size(), options, sequence.folder.string());
  if (!selected) {
    return fail(selected.error());
  }
  const auto first = firstUsable(sequence, *selected);
  if (!first) {
    return fail(first.error());
  }
  const cv::Size size = first->depth.size();
  const cv::Size color_size = sequence.has_color ? first->color.size() : size;
  if (options.color_camera) {
    const bool is_registered = *options.color_camera == ColorCamera{};
    sequence.color_camera = is_registered ? std::nullopt : options.color_camera;
  }
  // Registered images of one camera have one shape; a smaller colour or depth image is the same view resized.
  if (!sequence.color_camera && color_size.width * size.height != color_size.height * size.width) {
    return fail(sequence.folder.string() + ": the colour images are " + sizeText(color_size) +
                    ", the depth images " + sizeText(size) + ".",
                "They must show the same view: register and crop them to one shape, or give --color-camera.");
  }
  if (options.intrinsics) {
    sequence.camera.K = *options.intrinsics;
    sequence.camera.K.width = sequence.camera.K.height = 0;
    sequence.camera_origin = "--intrinsics";
  }
  SourceInfo info;
  info.name = folderName(sequence.folder);
  info.kind = sequence.kind;
  info.intrinsics = fitToImages(sequence.camera, size.width, size.height);
  info.frame_count = static_cast<int>(selected->size());
  info.has_poses = sequence.has_poses;
  SCANTROVE_TRY(checkIntrinsics(info.intrinsics, sequence.camera_origin));

  const double units_per_metre =
      options.depth_scale.value_or(sequence.camera.units_per_metre.value_or(sequence.units_per_metre));
  SCANTROVE_TRY(
      checkDepthScale(units_per_metre, options.depth_scale ? "--depth-scale" : sequence.camera_origin));
  warnOfImplausibleDepth(first->depth, 1.0 / units_per_metre, info.name);
  return std::make_unique<ImageSequenceSource>(std::move(sequence), std::move(*selected), std::move(info),
                                               color_size, 1.0 / units_per_metre);
}

}  // namespace scantrove
