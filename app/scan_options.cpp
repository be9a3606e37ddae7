#include "app/scan_options.h"

#include <cmath>

#include "app/number_check.h"
#include "core/scan/param_registry.h"

namespace scantrove {

void ScanOptions::addTo(CLI::App& command) {
  command.add_option("--frames", frames, "at most so many frames")->check(atLeast(1))->type_name("N");
  command.add_option("--start", start, "skip so many frames first")->check(atLeast(0))->type_name("N");
  command.add_option("--stride", stride, "then take every N-th")->check(atLeast(1))->type_name("N");
  command.add_option("--poses", poses, "'tracked' by the camera tracker, or 'given' by the recording")
      ->check(CLI::IsMember({"tracked", "given"}))
      ->type_name("tracked|given");
  command.add_option("--intrinsics", intrinsics, "camera of folders that do not carry one, pixels")
      ->expected(4)
      ->delimiter(',')
      ->type_name("fx,fy,cx,cy");
  command.add_option("--depth-scale", depth_scale, "depth units per metre of folders that do not carry it")
      ->check(above(0))
      ->type_name("S");
  command.add_option("--config", config, "parameters from a TOML file")
      ->check(CLI::ExistingFile)
      ->type_name("FILE");
  command.add_option("--set", settings, "one parameter; 'scantrove params' lists them")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)  // what follows it is the source
      ->type_name("key=value");
  command.add_option("--device", device, "OpenCL device; 'scantrove devices' lists them")
      ->type_name("INDEX|NAME");
}

ScanRequest ScanOptions::toRequest() const {
  ScanRequest request;
  request.source = source;
  request.source_options.start = start;
  request.source_options.stride = stride;
  if (frames > 0) request.source_options.frames = frames;
  if (depth_scale > 0) request.source_options.depth_scale = depth_scale;
  if (!intrinsics.empty()) {
    const bool is_camera = intrinsics.size() == 4 && intrinsics[0] > 0 && intrinsics[1] > 0 &&
                           std::isfinite(intrinsics[0]) && std::isfinite(intrinsics[1]) &&
                           std::isfinite(intrinsics[2]) && std::isfinite(intrinsics[3]);
    if (!is_camera) {
      throw CLI::ValidationError(
          "--intrinsics",
          "needs fx,fy,cx,cy in pixels with fx and fy above 0, for example 525,525,319.5,239.5");
    }
    Intrinsics K;
    K.fx = intrinsics[0];
    K.fy = intrinsics[1];
    K.cx = intrinsics[2];
    K.cy = intrinsics[3];
    request.source_options.intrinsics = K;
  }
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
