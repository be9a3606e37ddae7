#include "core/capture/freenect_source.h"

#include <utility>

#include "core/base/text.h"
#include "core/capture/camera_intrinsics.h"
#include "core/capture/color_registration.h"
#include "core/capture/freenect_camera.h"
#include "core/capture/paired_source.h"

namespace scantrove {

namespace {

constexpr std::size_t kMaxIndexDigits = 3;  // serial numbers are longer

FreenectChoice choiceOf(const std::string& uri) {
  const std::size_t colon = uri.find(':');
  const std::string which = colon == std::string::npos ? "" : uri.substr(colon + 1);
  const auto index = parseFrameNumber(which);
  if (which.empty() || (index && which.size() <= kMaxIndexDigits)) {
    return {index.value_or(0), {}};
  }
  return {0, which};
}

}  // namespace

bool hasFreenect() { return true; }

Result<std::vector<CameraInfo>> listFreenectCameras() { return listFreenectCameras(libfreenect()); }

Result<std::vector<CameraInfo>> listFreenectCameras(const FreenectApi& api) {
  const auto context = FreenectContext::create(api);
  if (!context) {
    return fail(context.error());
  }
  std::vector<CameraInfo> cameras;
  for (int i = 0; i < (*context)->count(); ++i) {
    cameras.push_back({"freenect:" + std::to_string(i), "Kinect v1", "Microsoft", "libfreenect"});
  }
  return cameras;
}

Result<std::unique_ptr<FrameSource>> openFreenectCamera(const std::string& uri,
                                                        const SourceOptions& options) {
  return openFreenectCamera(libfreenect(), uri, options);
}

Result<std::unique_ptr<FrameSource>> openFreenectCamera(const FreenectApi& api, const std::string& uri,
                                                        const SourceOptions& options) {
  const FreenectChoice choice = choiceOf(uri);
  const ColorRegistration color = options.color_registration.value_or(ColorRegistration{});
  auto camera = FreenectCamera::open(api, choice, !color.camera);
  if (!camera) {
    return fail(camera.error());
  }
  PairedSourceSetup setup;
  setup.info.name = choice.name();
  setup.info.kind = "libfreenect camera";
  setup.info.is_live = true;
  setup.info.intrinsics = options.intrinsics.value_or((*camera)->intrinsics());
  setup.info.intrinsics.width = FreenectCamera::kWidth;
  setup.info.intrinsics.height = FreenectCamera::kHeight;
  SCANTROVE_TRY(checkIntrinsics(setup.info.intrinsics, "--intrinsics"));
  setup.color_camera = colorCameraFor(color, (*camera)->colorSize(), setup.info.intrinsics, setup.info.name);
  if (!setup.color_camera) {
    return fail(setup.color_camera.error());
  }
  if (options.depth_scale) {
    setup.meters_per_unit = 1.0 / *options.depth_scale;
  }
  return std::make_unique<PairedSource>(std::move(*camera), std::move(setup), options);
}

}  // namespace scantrove
