#include "core/synthetic/synthetic_source.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/synthetic/kinect_noise.h"
#include "core/synthetic/lighting.h"
#include "core/synthetic/objects.h"
#include "core/synthetic/renderer.h"

namespace scantrove {
namespace {

constexpr double kFramesPerSecond = 30;
constexpr double kColorNoise = 1.8;  // grey levels

struct NamedScene {
  const char* name;
  SceneKind kind;
};
constexpr NamedScene kScenes[] = {{"tabletop", SceneKind::tabletop},
                                  {"room", SceneKind::room},
                                  {"l_block", SceneKind::l_block},
                                  {"chair_floor", SceneKind::chair_floor}};

SyntheticScene makeScene(SceneKind kind) {
  switch (kind) {
    case SceneKind::room:
      return synthetic::makeRoomScene();
    case SceneKind::l_block:
      return synthetic::makeLBlockScene();
    case SceneKind::chair_floor:
      return synthetic::makeChairFloorScene();
    case SceneKind::tabletop:
      break;
  }
  return synthetic::makeTabletopScene();
}

const char* nameOf(SceneKind kind) {
  const auto* found = std::find_if(std::begin(kScenes), std::end(kScenes),
                                   [kind](const NamedScene& s) { return s.kind == kind; });
  SCANTROVE_CHECK(found != std::end(kScenes));
  return found->name;
}

/// Metres to 16-bit units; 0 where there is no reading or it does not fit.
cv::Mat toUnits(const cv::Mat& z_m, float metres_per_unit) {
  cv::Mat depth(z_m.size(), CV_16UC1);
  for (int v = 0; v < z_m.rows; ++v) {
    const float* z = z_m.ptr<float>(v);
    std::uint16_t* out = depth.ptr<std::uint16_t>(v);
    for (int u = 0; u < z_m.cols; ++u) {
      const float units = z[u] / metres_per_unit + 0.5F;
      out[u] = units < 65535.0F ? static_cast<std::uint16_t>(units) : std::uint16_t{0};
    }
  }
  return depth;
}

class RenderedSource final : public SyntheticSource {
 public:
  explicit RenderedSource(const SyntheticOptions& options)
      : options_(options),
        scene_(makeScene(options.scene)),
        trajectory_(options.scene, options.tremor, options.seed) {
    info_.name = nameOf(options.scene);
    info_.kind = "synthetic";
    info_.intrinsics = options.K;
    info_.frame_count = (options.frames - options.start + options.stride - 1) / options.stride;
    info_.has_poses = true;
  }

  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  [[nodiscard]] const SyntheticScene& scene() const override { return scene_; }
  [[nodiscard]] Eigen::Isometry3d pose(int index) const override {
    return trajectory_.pose(index / kFramesPerSecond);
  }

  [[nodiscard]] FrameRead next() override {
    FrameRead read;
    if (given_ == *info_.frame_count) {
      return read;
    }
    const int index = options_.start + given_++ * options_.stride;
    if (options_.color && !lighting_) {
      const bool wide = options_.scene == SceneKind::room || options_.scene == SceneKind::chair_floor;
      lighting_ = std::make_unique<synthetic::Lighting>(scene_, Eigen::Vector3d(0, wide ? 0.8 : 0, 0.4),
                                                        wide ? 2.0 : 1.5);
    }
    RgbdFrame& frame = read.frame;
    frame.index = index;
    frame.timestamp_s = index / kFramesPerSecond;
    frame.metres_per_unit = options_.metres_per_unit;
    frame.T_world_camera = pose(index);
    synthetic::RenderedFrame image =
        synthetic::renderFrame(scene_, lighting_.get(), options_.K, *frame.T_world_camera);
    const auto number = static_cast<std::uint32_t>(index);
    if (options_.noise) {
      image.z_m = synthetic::measureDepth(image.z_m, image.incidence, options_.K, {}, options_.seed, number);
      synthetic::addColorNoise(image.color, kColorNoise, options_.seed, number);
    }
    frame.depth = toUnits(image.z_m, options_.metres_per_unit);
    frame.color = image.color;
    frame.instances = image.instances;
    read.status = FrameRead::Status::frame;
    return read;
  }

 private:
  SyntheticOptions options_;
  SyntheticScene scene_;
  synthetic::Trajectory trajectory_;
  std::unique_ptr<synthetic::Lighting> lighting_;  // baked when the first colour image is asked for
  SourceInfo info_;
  int given_ = 0;
};

}  // namespace

Result<std::unique_ptr<SyntheticSource>> makeSyntheticSource(const SyntheticOptions& given) {
  SyntheticOptions options = given;
  if (options.frames <= 0) {
    options.frames = synthetic::defaultFrameCount(options.scene);
  }
  const Intrinsics& K = options.K;
  if (!(K.fx > 0 && K.fy > 0) || K.width <= 0 || K.height <= 0) {
    return fail(fmt::format("The demo cannot be filmed with fx {} fy {} at {} x {} pixels.", K.fx, K.fy,
                            K.width, K.height),
                "Give positive focal lengths in pixels.");
  }
  if (options.start < 0 || options.stride < 1 || options.start >= options.frames) {
    return fail(fmt::format("The demo '{}' has {} frames; none is left from frame {} in steps of {}.",
                            nameOf(options.scene), options.frames, options.start, options.stride),
                "Start earlier, with a step of 1 or more.");
  }
  if (!(options.metres_per_unit > 0)) {
    return fail(fmt::format("A depth unit of {} m is none.", options.metres_per_unit),
                "Give a positive depth scale.");
  }
  return std::make_unique<RenderedSource>(options);
}

Result<std::unique_ptr<FrameSource>> makeSyntheticSource(const std::string& scene,
                                                         const SourceOptions& given) {
  SyntheticOptions options;
  const std::size_t colon = scene.find(':');
  const std::string name = colon == 0 || scene.empty() ? "tabletop" : scene.substr(0, colon);
  const std::string mode = colon == std::string::npos ? "" : scene.substr(colon + 1);
  const auto* found = std::find_if(std::begin(kScenes), std::end(kScenes),
                                   [&](const NamedScene& s) { return name == s.name; });
  if (found == std::end(kScenes) || !(mode.empty() || mode == "exact")) {
    return fail(
        fmt::format("There is no demo scene '{}'.", scene),
        "Choose tabletop or room (l_block and chair_floor for tests); add :exact for depth without noise.");
  }
  options.scene = found->kind;
  options.noise = mode != "exact";
  options.start = given.start;
  options.stride = given.stride;
  if (given.intrinsics) {
    const Intrinsics size = options.K;
    options.K = *given.intrinsics;
    options.K.width = size.width;
    options.K.height = size.height;
  }
  if (given.depth_scale) {
    options.metres_per_unit = static_cast<float>(1.0 / *given.depth_scale);
  }
  const int length = synthetic::defaultFrameCount(options.scene);
  options.frames = length;
  if (given.frames && options.stride >= 1 && *given.frames < (length - options.start) / options.stride) {
    options.frames = options.start + std::max(*given.frames, 0) * options.stride;
  }
  auto source = makeSyntheticSource(options);
  if (!source) {
    return fail(source.error());
  }
  return std::move(*source);
}

std::vector<InstanceName> instanceNames(SceneKind scene) { return makeScene(scene).instances(); }

}  // namespace scantrove
