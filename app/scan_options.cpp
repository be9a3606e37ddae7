#include "app/scan_options.h"

#include <cmath>

#include "app/number_check.h"
#include "core/base/text.h"
#include "core/capture/camera_intrinsics.h"
#include "core/capture/source_options.h"
#include "core/scan/param_registry.h"

namespace scantrove {
namespace {

/// `count` numbers separated by commas, or wrong usage.
std::vector<float> numbersFrom(const std::string& option, const std::string& text, std::size_t count,
                               const std::string& advice) {
  const auto numbers = parseNumbers(text);
  if (!numbers || numbers->size() != count) {
    throw CLI::ValidationError(option,
                               "'" + text + "' is not " + std::to_string(count) + " numbers: " + advice);
  }
  return {numbers->begin(), numbers->end()};
}

Intrinsics intrinsicsFrom(const std::string& text) {
  const auto values =
      numbersFrom("--intrinsics", text, 4, "fx,fy,cx,cy in pixels, for example 525,525,319.5,239.5");
  return {values[0], values[1], values[2], values[3], 0, 0};
}

ColorCamera colorCameraFrom(const std::string& text) {
  if (text == "registered") return {};
  const auto values = numbersFrom(
      "--color-camera", text, 5,
      "'registered', or fx,fy,cx,cy in pixels and x in metres, for example 525,525,320,240,-0.025");
  const ColorCamera camera{values[0], values[1], values[2], values[3], values[4]};
  const Intrinsics K{camera.fx, camera.fy, camera.cx, camera.cy, 0, 0};
  const bool is_near = std::abs(camera.offset_x_m) < 1;
  if (!checkFocalLengths(K, "--color-camera") || !is_near) {
    throw CLI::ValidationError("--color-camera", "'" + text + "' is no camera beside the depth camera");
  }
  return camera;
}

}  // namespace

void ScanOptions::addSourceTo(CLI::App& command) {
  command.add_option("--frames", frames, "at most so many frames")->transform(wholeNumber(1))->type_name("N");
  command.add_option("--start", start, "skip so many frames first")
      ->transform(wholeNumber(0))
      ->type_name("N");
  command.add_option("--stride", stride, "then take every N-th")->transform(wholeNumber(1))->type_name("N");
  command.add_option("--intrinsics", intrinsics, "camera of folders that do not carry one, pixels")
      ->type_name("fx,fy,cx,cy");
  command.add_option("--depth-scale", depth_scale, "depth units per metre of folders that do not carry it")
      ->check(above(0))
      ->type_name("S");
  command
      .add_option(
          "--color-camera", color_camera,
          "colour camera of folders whose colour is not registered to depth: its pixels, and x (in metres)\n"
          "of a point less its x for the depth camera; 'registered' if it is (7-Scenes: its own Kinect)")
      ->type_name("registered|fx,fy,cx,cy,x");
}

void ScanOptions::addTo(CLI::App& command) {
  addSourceTo(command);
  command.add_option("--poses", poses, "'tracked' by the camera tracker, or 'given' by the recording")
      ->check(CLI::IsMember({"tracked", "given"}))
      ->type_name("tracked|given");
  command.add_option("--config", config, "parameters from a TOML file")->type_name("FILE");
  command.add_option("--set", settings, "one parameter; 'scantrove params' lists them")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)  // what follows it is the source
      ->type_name("key=value");
  command.add_option("--device", device, "OpenCL device; 'scantrove devices' lists them")
      ->type_name("INDEX|NAME");
}

SourceOptions ScanOptions::toSourceOptions() const {
  SourceOptions source_options;
  source_options.start = start;
  source_options.stride = stride;
  if (frames > 0) source_options.frames = frames;
  if (depth_scale > 0) source_options.depth_scale = depth_scale;
  if (!intrinsics.empty()) source_options.intrinsics = intrinsicsFrom(intrinsics);
  if (!color_camera.empty()) source_options.color_camera = colorCameraFrom(color_camera);
  if (const auto checked = checkSourceOptions(source_options); !checked) {
    throw CLI::ValidationError(checked.error().message(), CLI::ExitCodes::ValidationError);
  }
  return source_options;
}

ScanRequest ScanOptions::toRequest() const {
  ScanRequest request;
  request.source = source;
  request.source_options = toSourceOptions();
  request.poses = poses == "given" ? ScanRequest::Poses::given : ScanRequest::Poses::tracked;
  request.params = paramsFrom(config, settings);
  request.device = device;
  return request;
}

ScanParams paramsFrom(const std::string& config, const std::vector<std::string>& settings) {
  ScanParams params;
  if (!config.empty()) {
    if (const auto loaded = loadConfig(params, config); !loaded) {
      throw CLI::ValidationError("--config", loaded.error().message());
    }
  }
  for (const std::string& setting : settings) {
    if (const auto applied = applySetting(params, setting); !applied) {
      throw CLI::ValidationError("--set", applied.error().message());
    }
  }
  return params;
}

}  // namespace scantrove
