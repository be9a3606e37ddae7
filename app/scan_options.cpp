#include "app/scan_options.h"

#include "app/number_check.h"
#include "core/base/text.h"
#include "core/capture/color_registration.h"
#include "core/capture/source_options.h"
#include "core/session/param_registry.h"

namespace scantrove {
namespace {

Intrinsics intrinsicsFrom(const std::string& text) {
  const auto values = parseNumbers(text);
  if (!values || values->size() != 4) {
    throw CLI::ValidationError(
        "--intrinsics",
        "'" + text + "' is not 4 numbers: fx,fy,cx,cy in pixels, for example 525,525,319.5,239.5");
  }
  const auto at = [&](std::size_t i) { return static_cast<float>((*values)[i]); };
  return {at(0), at(1), at(2), at(3), 0, 0};
}

ColorRegistration colorRegistrationFrom(const std::string& text) {
  const auto parsed = parseColorRegistration(text);
  if (!parsed) throw CLI::ValidationError("--color-registration", parsed.error().message());
  return *parsed;
}

}  // namespace

void ScanOptions::addSourceTo(CLI::App& command) {
  command.add_option("--frames", frames, "maximum number of frames")
      ->transform(wholeNumber(1))
      ->type_name("N");
  command.add_option("--start", start, "number of frames to skip at the start")
      ->transform(wholeNumber(0))
      ->type_name("N");
  command.add_option("--stride", stride, "use every N-th frame")->transform(wholeNumber(1))->type_name("N");
  command.add_option("--intrinsics", intrinsics, "camera in pixels, for folders that do not give it")
      ->type_name("fx,fy,cx,cy");
  command
      .add_option(
          "--depth-scale", depth_scale,
          "depth units per metre, for folders that do not give it\n(1 for floating-point depth in metres)")
      ->check(above(0))
      ->type_name("S");
  command
      .add_option(
          "--color-registration", color_registration,
          "how the colour image is aligned with depth: 'registered', 'kinect' (factory values of a Kinect\n"
          "v1), or the colour camera: intrinsics in pixels, then the transform from depth camera to colour\n"
          "camera coordinates: translation (x, or x,y,z) in metres, optional rotation in degrees\n"
          "(default: from the source)")
      ->type_name("registered|kinect|fx,fy,cx,cy,x[,y,z[,rx,ry,rz]]");
  command
      .add_option("--depth-topic", depth_topic,
                  "topic of the depth images, for ROS recordings that have several")
      ->type_name("NAME");
  command
      .add_option("--color-topic", color_topic,
                  "topic of the colour images, for ROS recordings that have several")
      ->type_name("NAME");
}

void ScanOptions::addTo(CLI::App& command) {
  addSourceTo(command);
  command.add_option("--loop", loops, "read the recording N times, as one long recording")
      ->transform(wholeNumber(1))
      ->type_name("N");
  command
      .add_option(
          "--poses", poses,
          "'auto': a device's own poses (not a benchmark's truth) are the prediction, the map refines\n"
          "them, and where tracking is lost they continue; other recordings are tracked. 'tracked': by\n"
          "the camera tracker alone. 'given': by the recording (default: auto; with --resume, as the\n"
          "session was scanned)")
      ->check(CLI::IsMember({"auto", "tracked", "given"}))
      ->type_name("auto|tracked|given");
  command.add_option("--config", config, "parameters from a TOML file")->type_name("FILE");
  command.add_option("--set", settings, "one parameter; 'scantrove params' lists them")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)  // the next argument is SOURCE
      ->type_name("key=value");
  command.add_option("--device", device, "OpenCL device; 'scantrove devices' lists them")
      ->type_name("INDEX|NAME");
}

SourceOptions ScanOptions::toSourceOptions() const {
  SourceOptions source_options;
  source_options.start = start;
  source_options.stride = stride;
  source_options.loops = loops;
  if (frames > 0) source_options.frames = frames;
  if (depth_scale > 0) source_options.depth_scale = depth_scale;
  source_options.depth_topic = depth_topic;
  source_options.color_topic = color_topic;
  if (!intrinsics.empty()) source_options.intrinsics = intrinsicsFrom(intrinsics);
  if (!color_registration.empty()) {
    source_options.color_registration = colorRegistrationFrom(color_registration);
  }
  if (const auto checked = checkSourceOptions(source_options); !checked) {
    throw CLI::ValidationError(checked.error().message(), CLI::ExitCodes::ValidationError);
  }
  return source_options;
}

ScanRequest ScanOptions::toRequest() const {
  ScanRequest request;
  request.source = source;
  request.source_options = toSourceOptions();
  request.poses = posesFrom(poses).value_or(ScanRequest::Poses::automatic);
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
