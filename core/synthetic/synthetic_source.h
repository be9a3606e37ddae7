#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/capture/frame_source.h"
#include "core/synthetic/device_path.h"
#include "core/synthetic/phone_camera.h"
#include "core/synthetic/scene_recipe.h"

namespace scantrove {

/// Parameters of a synthetic recording. World frame: metres, z up, floor at z = 0.
struct SyntheticOptions {
  std::function<synthetic::SceneRecipe()> recipe =
      synthetic::makeTabletopScene;  ///< makes the scene and its camera path
  Intrinsics K{525.0F, 525.0F, 319.5F, 239.5F, 640, 480};
  std::optional<ColorCamera> color_camera;  ///< none: colour is registered and has the depth images' size
  int frames = 0;  ///< length of the recording; 0 = the scene's default; the camera path itself is endless
  int start = 0;   ///< first frame of the recording
  int stride = 1;  ///< then every stride-th frame
  std::optional<int> at_most;  ///< maximum number of frames
  bool noise = true;   ///< noise and failures of the recipe's camera; false: exact, rounded to the unit
  bool bumpy = false;  ///< surfaces with bumps of 2 - 5 mm
  bool low_contrast = false;     ///< walls, furniture and things share three tints
  synthetic::PhoneCamera phone;  ///< its default: a depth camera of fixed focus
  int color_width = 0;           ///< of registered colour images; 0: as wide as depth images
  bool color = true;             ///< false: no colour images (a good third faster)
  bool tremor = true;            ///< tremor of a hand
  /// The recording's poses are those of a device that tracks itself; none: the true ones.
  std::optional<synthetic::DeviceErrors> device = {};
  std::optional<double> frames_per_second = {};  ///< of the returned frames; none: 30, before `stride`
  std::uint32_t seed = 1;  ///< of noise, tremor, bumps and tints; `recipe` has its own seed
  float meters_per_unit = 0.001F;
};

/// A rendered recording at 30 frames a second (`timestamp_s` = index / 30) with exact poses (unless
/// SyntheticOptions::device) and instance masks, those of depth. Pixels without a reading have their
/// instance, too.
class SyntheticSource : public FrameSource {
 public:
  /// The scene at the last returned frame; before the first, its initial state.
  [[nodiscard]] virtual const SyntheticScene& scene() const = 0;
  /// Exact T_world_camera of a frame, by its `RgbdFrame::index`. Where the recipe has a reference, its world
  /// is that of the thing there.
  [[nodiscard]] virtual Eigen::Isometry3d pose(int index) const = 0;
};

/// Error: no frame is selected, or the intrinsics are invalid.
[[nodiscard]] Result<std::unique_ptr<SyntheticSource>> makeSyntheticSource(const SyntheticOptions& options);

/// `scene`: "tabletop" (also ""), "room", "sweep", "moving", "hands", "turntable", "wall" or "corridor".
/// Suffixes in any order: ":7" selects the random scene of that seed, ":hard" its hard generation (tabletop,
/// room; without a seed that of 1), ":exact" disables noise, ":uneven" adds bumps, ":drab" reduces the
/// colours, ":phone" gives depth of 256 x 192 with confidence, a focal length that swings by 2.5 %, and a
/// colour image of 960 x 720 for every third frame, ":device" gives the poses of a device that tracks itself.
/// Intrinsics in `options` apply to the rendered depth (its size stays, that of colour too). Error: names the
/// scene and lists the known ones.
[[nodiscard]] Result<std::unique_ptr<SyntheticSource>> makeSyntheticSource(const std::string& scene,
                                                                           const SourceOptions& options);

}  // namespace scantrove
