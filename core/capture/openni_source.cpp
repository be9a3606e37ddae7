#include "core/capture/openni_source.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "core/capture/camera_intrinsics.h"
#include "core/capture/cameras.h"
#include "core/capture/color_registration.h"
#include "core/capture/oni_file.h"
#include "core/capture/openni_streams.h"
#include "core/capture/paired_source.h"
#include "core/capture/source_options.h"

namespace scantrove {

namespace {

Result<std::unique_ptr<FrameSource>> makeSource(std::unique_ptr<OpenNiStreams> streams,
                                                const std::string& name, const SourceOptions& options) {
  PairedSourceSetup setup;
  SourceInfo& info = setup.info;
  info.name = name;
  info.is_live = !streams->isRecording();
  info.kind = info.is_live ? "OpenNI2 camera" : "OpenNI2 recording";
  const cv::Size size = streams->size();
  if (options.intrinsics) {
    info.intrinsics = *options.intrinsics;
    info.intrinsics.width = size.width;
    info.intrinsics.height = size.height;
  } else if (const auto K = streams->intrinsics()) {
    info.intrinsics = *K;
  } else {
    info.intrinsics = kPrimeSenseIntrinsics.resizedTo(size.width, size.height);
    spdlog::warn(
        "{} does not say its field of view; using 525,525,319.5,239.5 at 640x480. Give the right intrinsics "
        "with "
        "--intrinsics fx,fy,cx,cy.",
        name);
  }
  SCANTROVE_TRY(
      checkIntrinsics(info.intrinsics, options.intrinsics ? "--intrinsics" : "field of view of " + name));
  setup.available = streams->depthFrameCount();
  if (setup.available > 0) {
    const auto selected = selectFrames(static_cast<std::size_t>(setup.available), options, name);
    if (!selected) {
      return fail(selected.error());
    }
    info.frame_count = static_cast<int>(selected->size());
  }
  setup.meters_per_unit = options.depth_scale ? 1.0 / *options.depth_scale : streams->metersPerUnit();
  if (streams->hasColor()) {
    const ColorRegistration color = options.color_registration.value_or(ColorRegistration{});
    setup.color_camera = colorCameraFor(color, streams->colorSize(), info.intrinsics, name);
    if (!setup.color_camera && options.color_registration) return fail(setup.color_camera.error());
    if (!setup.color_camera)
      spdlog::warn("{} Going on without colour.", setup.color_camera.error().message());
  }
  return std::make_unique<PairedSource>(std::move(streams), std::move(setup), options);
}

}  // namespace

Result<std::unique_ptr<FrameSource>> openOpenNiCamera(const std::string& uri, const SourceOptions& options) {
  if (std::error_code error; std::filesystem::exists(uri, error)) {  // OpenNI2 accepts file paths as URIs
    SCANTROVE_TRY(checkOniFile(uri));
  }
  auto streams = std::make_unique<OpenNiStreams>();
  const bool is_to_register = !options.color_registration || !options.color_registration->camera;
  if (const auto opened = streams->open(uri, is_to_register); !opened) {
    return fail(opened.error().what, opened.error().advice.empty() ? cameraAdvice() : opened.error().advice);
  }
  const std::string name = streams->name();
  return makeSource(std::move(streams), name.empty() ? uri : name, options);
}

Result<std::unique_ptr<FrameSource>> openOniRecording(const std::filesystem::path& file,
                                                      const SourceOptions& options) {
  SCANTROVE_TRY(checkOniFile(file));
  auto streams = std::make_unique<OpenNiStreams>();
  if (const auto opened = streams->open(file.string(), true); !opened) {
    return fail(opened.error().what, opened.error().advice.empty()
                                         ? "Is the file a complete OpenNI recording?"
                                         : opened.error().advice);
  }
  return makeSource(std::move(streams), file.filename().string(), options);
}

}  // namespace scantrove
