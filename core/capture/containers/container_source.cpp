#include "core/capture/containers/container_source.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "core/capture/color_registration.h"
#include "core/capture/depth_plausibility.h"
#include "core/capture/source_options.h"

namespace scantrove {

namespace {

constexpr std::size_t kProbedContainerFrames = 50;

std::string containerSizeText(const cv::Size& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

/// How a container's images become frames.
struct ContainerSetup {
  SourceInfo info;
  std::vector<std::size_t> selected;  ///< positions of the frames
  cv::Size color_size;
  bool has_color = false;
  std::optional<ColorCamera> color_camera;  ///< none: registered
  std::optional<Undistorter> depth_undistorter, color_undistorter;
  float meters_per_unit = 0.001F;
};

class ContainerSource final : public FrameSource {
 public:
  ContainerSource(std::unique_ptr<ContainerImages> images, ContainerSetup setup)
      : images_(std::move(images)), setup_(std::move(setup)) {}

  [[nodiscard]] const SourceInfo& info() const override { return setup_.info; }

  [[nodiscard]] FrameRead next() override {
    FrameRead read;
    if (next_ == setup_.selected.size()) return read;
    const std::size_t position = setup_.selected[next_++];
    read.frame.index = static_cast<int>(position);
    Result<ContainerFrame> images = images_->read(position);
    const Result<void> usable = images ? checkSizes(*images, position) : fail(images.error());
    if (!usable) {
      read.status = FrameRead::Status::skipped;
      read.error = usable.error();
      return read;
    }
    read.status = FrameRead::Status::frame;
    RgbdFrame& frame = read.frame;
    frame.timestamp_s = images->timestamp_s;
    frame.meters_per_unit = setup_.meters_per_unit;
    frame.depth = setup_.depth_undistorter ? setup_.depth_undistorter->ofDepth(images->depth) : images->depth;
    if (!setup_.has_color) return read;
    frame.color_camera = setup_.color_camera;
    const bool is_to_undistort = setup_.color_undistorter && !images->color.empty();
    frame.color = is_to_undistort ? setup_.color_undistorter->ofColor(images->color) : images->color;
    return read;
  }

 private:
  [[nodiscard]] Result<void> checkSizes(const ContainerFrame& images, std::size_t position) const {
    const auto differs = [&](const char* kind, const cv::Size& size, const cv::Size& first) {
      return fail("The " + std::string(kind) + " image of frame " + std::to_string(position) + " of " +
                  setup_.info.name + " is " + containerSizeText(size) + ", that of the first frame " +
                  containerSizeText(first) + ".");
    };
    const cv::Size depth(setup_.info.intrinsics.width, setup_.info.intrinsics.height);
    if (images.depth.size() != depth) return differs("depth", images.depth.size(), depth);
    if (setup_.has_color && !images.color.empty() && images.color.size() != setup_.color_size)
      return differs("colour", images.color.size(), setup_.color_size);
    return {};
  }

  std::unique_ptr<ContainerImages> images_;
  ContainerSetup setup_;
  std::size_t next_ = 0;  // in setup_.selected
};

/// The first frame that can be decoded, one with colour if there is one.
Result<ContainerFrame> firstContainerFrame(ContainerImages& images, const std::vector<std::size_t>& selected,
                                           const std::string& path) {
  std::optional<Error> first_error;
  std::optional<ContainerFrame> without_color;
  const std::size_t probed = std::min(selected.size(), kProbedContainerFrames);
  for (std::size_t i = 0; i < probed; ++i) {
    Result<ContainerFrame> frame = images.read(selected[i]);
    if (frame && (!images.hasColor() || !frame->color.empty())) return frame;
    if (frame && !without_color) without_color = std::move(*frame);
    if (!frame && !first_error) first_error = frame.error();
  }
  if (without_color) return std::move(*without_color);
  return fail("None of the first " + std::to_string(probed) + " frames of " + path +
                  " can be used: " + first_error.value_or(Error{}).what,
              first_error.value_or(Error{}).advice);
}

/// Chooses the depth camera.
Result<void> setDepthCamera(ContainerSetup& setup, ContainerCameras& cameras, const ContainerFrame& first,
                            const std::string& path, const SourceOptions& options) {
  CameraModel& model = cameras.depth;
  const cv::Size size = first.depth.size();
  std::string origin = "in " + path;
  if (options.intrinsics) {
    const bool is_known =
        model.K.fx > 0 && isSameCamera(fitToImages(model, size.width, size.height), *options.intrinsics);
    if (!is_known) model.lens.reset();  // it belongs to another camera
    model.K = *options.intrinsics;
    model.K.width = model.K.height = 0;
    origin = "--intrinsics";
  }
  if (!(model.K.fx > 0)) {
    return fail(path + " does not say the intrinsics of its depth camera.",
                "Give --intrinsics fx,fy,cx,cy in pixels.");
  }
  setup.info.intrinsics = fitToImages(model, size.width, size.height);
  SCANTROVE_TRY(checkIntrinsics(setup.info.intrinsics, origin));
  if (model.lens && !model.lens->isZero())
    setup.depth_undistorter.emplace(*model.lens, setup.info.intrinsics);
  const double units = options.depth_scale.value_or(model.units_per_meter.value_or(1000));
  SCANTROVE_TRY(checkDepthScale(units, options.depth_scale ? "--depth-scale" : origin));
  setup.meters_per_unit = static_cast<float>(1 / units);
  return {};
}

/// Chooses the colour camera. A recording whose colour cannot be used is read without it.
Result<void> setColorCamera(ContainerSetup& setup, const ContainerCameras& cameras,
                            const ContainerFrame& first, const std::string& path,
                            const SourceOptions& options) {
  if (first.color.empty()) return {};
  setup.color_size = first.color.size();
  const ColorRegistration registration =
      options.color_registration.value_or(ColorRegistration{cameras.color});
  const bool is_place_known = options.color_registration || cameras.is_color_place_known;
  const auto camera = colorCameraFor(registration, setup.color_size, setup.info.intrinsics, path);
  if (!camera && options.color_registration) return fail(camera.error());
  if (!camera) {
    spdlog::warn("{} Going on without colour.", camera.error().message());
    return {};
  }
  if (!is_place_known)
    spdlog::warn(
        "{} does not say where its colour camera is; colour is taken to be registered to depth. Else give "
        "--color-registration.",
        path);
  setup.has_color = true;
  setup.color_camera = *camera;
  const Intrinsics K = setup.color_camera
                           ? setup.color_camera->K
                           : setup.info.intrinsics.resizedTo(setup.color_size.width, setup.color_size.height);
  if (!options.color_registration && cameras.color_lens && !cameras.color_lens->isZero())
    setup.color_undistorter.emplace(*cameras.color_lens, K);
  return {};
}

}  // namespace

Result<std::unique_ptr<FrameSource>> openContainerSource(std::unique_ptr<ContainerImages> images,
                                                         const std::filesystem::path& path,
                                                         const SourceOptions& options) {
  SCANTROVE_TRY(checkSourceOptions(options));
  ContainerSetup setup;
  SCANTROVE_TRY(moveInto(setup.selected, selectFrames(images->count(), options, path.string())));
  const Result<ContainerFrame> first = firstContainerFrame(*images, setup.selected, path.string());
  if (!first) return fail(first.error());
  Result<ContainerCameras> cameras = images->cameras(first->depth.size(), first->color.size());
  if (!cameras && !options.intrinsics) return fail(cameras.error());
  if (!cameras) {
    cameras = ContainerCameras();
    cameras->is_color_place_known = false;
  }
  setup.info.name = path.filename().string();
  setup.info.kind = images->kind();
  setup.info.frame_count = static_cast<int>(setup.selected.size());
  SCANTROVE_TRY(setDepthCamera(setup, *cameras, *first, path.string(), options));
  if (images->hasColor()) SCANTROVE_TRY(setColorCamera(setup, *cameras, *first, path.string(), options));
  setup.info.implausible_depth =
      warnOfImplausibleDepth(first->depth, 1.0 / static_cast<double>(setup.meters_per_unit), setup.info.name);
  return std::make_unique<ContainerSource>(std::move(images), std::move(setup));
}

}  // namespace scantrove
