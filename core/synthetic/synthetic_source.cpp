#include "core/synthetic/synthetic_source.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/synthetic/bumpy_shape.h"
#include "core/synthetic/color_exposure.h"
#include "core/synthetic/depth_loss.h"
#include "core/synthetic/kinect_noise.h"
#include "core/synthetic/lighting.h"
#include "core/synthetic/low_contrast_colors.h"
#include "core/synthetic/renderer.h"

namespace scantrove {
namespace {

constexpr double kFramesPerSecond = 30;
constexpr double kColorNoise = 1.8;  // grey levels

// The suffix ":phone".
constexpr synthetic::PhoneCamera kPhone{.breathing = 0.025, .colored = 1, .cycle = 3, .has_confidence = true};
constexpr Intrinsics kPhoneDepth{212, 212, 127.5F, 95.5F, 256, 192};
constexpr int kPhoneColorWidth_px = 960;

struct Demo {
  const char* name;
  synthetic::SceneRecipe (*recipe)();
  synthetic::SceneRecipe (*random_recipe)(std::uint32_t seed);
  synthetic::SceneRecipe (*hard_recipe)(std::uint32_t seed);
};
constexpr Demo kDemos[] = {
    {"tabletop", synthetic::makeTabletopScene, synthetic::makeRandomTabletopScene,
     synthetic::makeHardTabletopScene},
    {"room", synthetic::makeRoomScene, synthetic::makeRandomRoomScene, synthetic::makeHardRoomScene},
    {"sweep", [] { return synthetic::makeRandomSweepScene(1); }, synthetic::makeRandomSweepScene, nullptr},
    {"wall", synthetic::makeWallScene, nullptr, nullptr},
    {"corridor", synthetic::makeCorridorScene, nullptr, nullptr},
    {"moving", [] { return synthetic::makeRandomMovingScene(1); }, synthetic::makeRandomMovingScene, nullptr},
    {"hands", [] { return synthetic::makeRandomHandsScene(1); }, synthetic::makeRandomHandsScene,
     synthetic::makeRandomHandsScene},
    {"turntable", [] { return synthetic::makeRandomTurntableScene(1); }, synthetic::makeRandomTurntableScene,
     nullptr}};

/// Metres to 16-bit units; 0 for no reading or overflow.
cv::Mat toUnits(const cv::Mat& z_m, float meters_per_unit) {
  cv::Mat depth(z_m.size(), CV_16UC1);
  for (int v = 0; v < z_m.rows; ++v) {
    const float* z = z_m.ptr<float>(v);
    std::uint16_t* out = depth.ptr<std::uint16_t>(v);
    for (int u = 0; u < z_m.cols; ++u) {
      const float units = z[u] / meters_per_unit + 0.5F;
      out[u] = units < 65535.0F ? static_cast<std::uint16_t>(units) : std::uint16_t{0};
    }
  }
  return depth;
}

class RenderedSource final : public SyntheticSource {
 public:
  RenderedSource(const SyntheticOptions& options, synthetic::SceneRecipe recipe)
      : options_(options),
        recipe_(std::move(recipe)),
        trajectory_(recipe_.path, options.tremor && recipe_.is_hand_held, options.seed) {
    if (options.device) {
      device_.emplace(*options.device, options.seed, [this](int index) { return pose(index); });
      info_.pose_origin = PoseOrigin::device;
    }
    info_.name = recipe_.name;
    info_.kind = "synthetic";
    info_.intrinsics = options.K;
    info_.frame_count = (options.frames - options.start + options.stride - 1) / options.stride;
    info_.has_poses = true;
    info_.is_color_optional = options.color && options.phone.colored < options.phone.cycle;
    info_.instances = recipe_.scene.instances();
    for (const SyntheticScene::Part& part : recipe_.scene.parts()) T_world_rest_.push_back(part.T_world_part);
    for (InstanceName& who : info_.instances)
      who.extent_m = recipe_.scene.boundsOf(who.id).sizes().maxCoeff();
  }

  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  [[nodiscard]] const SyntheticScene& scene() const override { return recipe_.scene; }
  [[nodiscard]] Eigen::Isometry3d pose(int index) const override {
    const double time_s = index / kFramesPerSecond;
    const Eigen::Isometry3d T_world_camera = trajectory_.pose(time_s);
    return recipe_.reference ? recipe_.reference(time_s).inverse() * T_world_camera : T_world_camera;
  }

  [[nodiscard]] FrameRead next() override {
    FrameRead read;
    if (given_ == *info_.frame_count) {
      return read;
    }
    const int number_of_frame = given_++;
    const int index = options_.start + number_of_frame * options_.stride;
    const bool has_color = options_.color && options_.phone.hasColor(index);
    if (has_color && !lighting_) {
      lighting_ = std::make_unique<synthetic::Lighting>(recipe_.scene, recipe_.lit_center,
                                                        recipe_.lit_radius_m, recipe_.lights);
    }
    moveTo(index / kFramesPerSecond);
    RgbdFrame& frame = read.frame;
    frame.index = index;
    frame.timestamp_s =
        options_.frames_per_second ? number_of_frame / *options_.frames_per_second : index / kFramesPerSecond;
    frame.meters_per_unit = options_.meters_per_unit;
    frame.T_world_camera = device_ ? device_->pose(index) : pose(index);
    const Eigen::Isometry3d true_pose = trajectory_.pose(index / kFramesPerSecond);  // in the room
    const Intrinsics K_depth = options_.phone.intrinsicsAt(frame.timestamp_s, options_.K);
    if (options_.phone.breathing > 0) frame.intrinsics = K_depth;
    const bool is_registered = !options_.color_camera;
    const bool is_one_image = is_registered && options_.color_width == 0;
    synthetic::RenderedFrame image = synthetic::renderFrame(
        recipe_.scene, has_color && is_one_image ? lighting_.get() : nullptr, K_depth, true_pose);
    if (has_color && !is_registered) {
      const Eigen::Isometry3d T_depth_color = options_.color_camera->T_color_depth.inverse();
      const Intrinsics& K = options_.color_camera->K;
      const synthetic::RenderedFrame of_color =
          synthetic::renderFrame(recipe_.scene, lighting_.get(), K, true_pose * T_depth_color);
      frame.color = exposed(of_color, K, T_depth_color, index);
      frame.color_camera = options_.color_camera;
    } else if (has_color && is_one_image) {
      frame.color = exposed(image, K_depth, Eigen::Isometry3d::Identity(), index);
    } else if (has_color) {
      const int height = std::max(1, options_.color_width * K_depth.height / K_depth.width);
      const Intrinsics K = K_depth.resizedTo(options_.color_width, height);
      frame.color = exposed(synthetic::renderFrame(recipe_.scene, lighting_.get(), K, true_pose), K,
                            Eigen::Isometry3d::Identity(), index);
    }
    const auto number = static_cast<std::uint32_t>(index);
    if (options_.noise) {
      image.z_m = measured(image, K_depth, number);
      synthetic::addColorNoise(frame.color, kColorNoise, options_.seed, number);
    }
    if (options_.phone.has_confidence) frame.confidence = synthetic::blurSteps(image.z_m);
    frame.depth = toUnits(image.z_m, options_.meters_per_unit);
    frame.instances = image.instances;
    read.status = FrameRead::Status::frame;
    return read;
  }

 private:
  void moveTo(double time_s) {
    for (const synthetic::AnimatedPart& animated : recipe_.animated_parts) {
      const Eigen::Isometry3d motion = animated.motion(time_s);
      for (std::size_t part = animated.first_part; part < animated.first_part + animated.part_count; ++part)
        recipe_.scene.setPose(part, motion * T_world_rest_[part]);
    }
  }

  /// Depth as the camera measures it.
  [[nodiscard]] cv::Mat measured(const synthetic::RenderedFrame& image, const Intrinsics& K,
                                 std::uint32_t number) const {
    const synthetic::KinectModel model = recipe_.camera ? recipe_.camera->depth : synthetic::KinectModel{};
    cv::Mat z_m = synthetic::measureDepth(image.z_m, image.incidence, K, model, options_.seed, number);
    if (recipe_.camera) {
      const cv::Mat light = synthetic::returnedLight(image, recipe_.scene.parts());
      synthetic::loseReadings(z_m, light, model, options_.seed, number);
    }
    return z_m;
  }

  /// The colour of `image`, at the moments of the camera's exposure.
  [[nodiscard]] cv::Mat exposed(const synthetic::RenderedFrame& image, const Intrinsics& K,
                                const Eigen::Isometry3d& T_depth_color, int index) const {
    if (!recipe_.camera || !options_.noise) return image.color;
    std::vector<synthetic::PartMotions> moments;
    for (const double after_s : colorMoments(*recipe_.camera, static_cast<std::uint32_t>(index)))
      moments.push_back(motionsUntil(after_s, T_depth_color, index));
    return synthetic::exposeColor(image, K, moments);
  }

  /// Motions in the colour camera's frame, from a frame's depth image to `after_s` later.
  [[nodiscard]] synthetic::PartMotions motionsUntil(double after_s, const Eigen::Isometry3d& T_depth_color,
                                                    int index) const {
    const double time_s = index / kFramesPerSecond;
    const Eigen::Isometry3d T_world_now = trajectory_.pose(time_s) * T_depth_color;
    const Eigen::Isometry3d T_later_world = (trajectory_.pose(time_s + after_s) * T_depth_color).inverse();
    synthetic::PartMotions motions(recipe_.scene.parts().size() + 1,
                                   (T_later_world * T_world_now).cast<float>());
    for (const synthetic::AnimatedPart& animated : recipe_.animated_parts) {
      const Eigen::Isometry3d motion = animated.motion(time_s + after_s) * animated.motion(time_s).inverse();
      for (std::size_t part = animated.first_part; part < animated.first_part + animated.part_count; ++part)
        motions[part] = (T_later_world * motion * T_world_now).cast<float>();
    }
    return motions;
  }

  SyntheticOptions options_;
  synthetic::SceneRecipe recipe_;
  std::vector<Eigen::Isometry3d> T_world_rest_;  // initial poses of the parts
  synthetic::Trajectory trajectory_;
  std::optional<synthetic::DevicePath> device_;
  std::unique_ptr<synthetic::Lighting> lighting_;  // baked at the first colour image
  SourceInfo info_;
  int given_ = 0;
};

/// Parses the suffixes of a scene's name: words and a seed between colons. False: unknown suffix.
bool applyModes(SyntheticOptions& options, const Demo& demo, std::string_view modes) {
  auto random_recipe = demo.random_recipe;
  bool is_random = false;
  while (!modes.empty()) {
    const std::size_t colon = std::min(modes.find(':'), modes.size());
    const std::string_view mode = modes.substr(0, colon);
    modes.remove_prefix(std::min(colon + 1, modes.size()));
    if (mode == "exact") {
      options.noise = false;
    } else if (mode == "uneven") {
      options.bumpy = true;
    } else if (mode == "drab") {
      options.low_contrast = true;
    } else if (mode == "phone") {
      options.phone = kPhone;
      options.K = kPhoneDepth;
      options.color_width = kPhoneColorWidth_px;
    } else if (mode == "device") {
      options.device.emplace();
    } else if (mode == "hard") {
      random_recipe = demo.hard_recipe;
      is_random = true;
    } else {
      const char* end = mode.data() + mode.size();
      const auto [stop, failure] = std::from_chars(mode.data(), end, options.seed);
      if (failure != std::errc{} || stop != end) return false;
      is_random = true;
    }
  }
  if (!is_random) return true;
  if (random_recipe == nullptr) return false;
  options.recipe = [random_recipe, seed = options.seed] { return random_recipe(seed); };
  return true;
}

}  // namespace

Result<std::unique_ptr<SyntheticSource>> makeSyntheticSource(const SyntheticOptions& given) {
  SyntheticOptions options = given;
  synthetic::SceneRecipe recipe = options.recipe();
  if (options.bumpy) recipe.scene = synthetic::makeBumpy(std::move(recipe.scene), options.seed);
  if (options.low_contrast) recipe.scene = synthetic::makeLowContrast(std::move(recipe.scene), options.seed);
  if (options.frames <= 0) {
    options.frames = recipe.frames;
  }
  if (options.at_most && options.stride >= 1 &&
      *options.at_most < (options.frames - options.start) / options.stride) {
    options.frames = options.start + std::max(*options.at_most, 0) * options.stride;
  }
  const Intrinsics& K = options.K;
  if (!(K.fx > 0 && K.fy > 0) || K.width <= 0 || K.height <= 0) {
    return fail(fmt::format("The demo cannot be rendered with fx {} fy {} at {} x {} pixels.", K.fx, K.fy,
                            K.width, K.height),
                "Give positive focal lengths in pixels.");
  }
  if (options.start < 0 || options.stride < 1 || options.start >= options.frames) {
    return fail(fmt::format("The demo '{}' has {} frames; none is left from frame {} in steps of {}.",
                            recipe.name, options.frames, options.start, options.stride),
                "Start earlier, with a step of 1 or more.");
  }
  const synthetic::PhoneCamera& phone = options.phone;
  if (!(phone.breathing >= 0 && phone.breathing < 1) || phone.cycle < 1 || options.color_width < 0) {
    return fail(
        "The demo cannot be rendered with this camera.",
        "Give a change of the focal length below 1, a cycle of at least one frame and a width of 0 or more.");
  }
  if (!(options.meters_per_unit > 0)) {
    return fail(fmt::format("A depth unit of {} m is none.", options.meters_per_unit),
                "Give a positive depth scale.");
  }
  return std::make_unique<RenderedSource>(options, std::move(recipe));
}

Result<std::unique_ptr<SyntheticSource>> makeSyntheticSource(const std::string& scene,
                                                             const SourceOptions& given) {
  SyntheticOptions options;
  const std::size_t colon = std::min(scene.find(':'), scene.size());
  const std::string name = colon == 0 ? "tabletop" : scene.substr(0, colon);
  const std::string_view modes = std::string_view(scene).substr(std::min(colon + 1, scene.size()));
  const auto* demo =
      std::find_if(std::begin(kDemos), std::end(kDemos), [&](const Demo& d) { return name == d.name; });
  if (demo != std::end(kDemos)) {
    options.recipe = demo->recipe;
  }
  if (demo == std::end(kDemos) || !applyModes(options, *demo, modes)) {
    return fail(fmt::format("There is no demo scene '{}'.", scene),
                "Choose tabletop, room, sweep, moving, hands, turntable, wall or corridor; add :7 for the "
                "random scene "
                "of that seed (not of wall and corridor), :hard for a camera that fails as real ones do "
                "(tabletop and room), "
                ":uneven for bumps on its surfaces, :drab for few colours, :exact for depth without noise, "
                ":phone for a telephone's camera, :device for the poses of a phone that tracks itself.");
  }
  options.start = given.start;
  options.stride = given.stride;
  options.at_most = given.frames;
  if (given.intrinsics) {
    const Intrinsics size = options.K;
    options.K = *given.intrinsics;
    options.K.width = size.width;
    options.K.height = size.height;
  }
  if (given.color_registration && given.color_registration->camera) {
    options.color_camera = given.color_registration->camera;
    options.color_camera->K.width = options.K.width;
    options.color_camera->K.height = options.K.height;
    options.color_width = 0;
  }
  if (given.depth_scale) {
    options.meters_per_unit = static_cast<float>(1.0 / *given.depth_scale);
  }
  return makeSyntheticSource(options);
}

}  // namespace scantrove
