#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/capture/frame_source.h"
#include "core/synthetic/scene_recipe.h"

namespace scantrove {

/// How to film a synthetic scene. World frame: metres, z up, floor at z = 0.
struct SyntheticOptions {
  std::function<synthetic::SceneRecipe()> set = synthetic::makeTabletopSet;  ///< makes what is filmed
  Intrinsics K{525.0F, 525.0F, 319.5F, 239.5F, 640, 480};
  std::optional<ColorCamera> color_camera;  ///< none: colour is registered, of the depth images' size
  int frames = 0;  ///< length of the recording; 0 = the set's own; the camera goes on as long as asked
  int start = 0;   ///< first frame of the recording that is given ...
  int stride = 1;  ///< ... and then every stride-th
  std::optional<int> at_most;  ///< so many of them
  bool noise = true;  ///< Kinect model on depth and sensor noise on colour; false: exact, rounded to the unit
  bool bumpy = false;         ///< surfaces with bumps of 2 - 5 mm
  bool low_contrast = false;  ///< walls, furniture and things share three tints
  bool color = true;          ///< false: no colour images (a good third faster)
  bool tremor = true;         ///< the small shaking of a hand
  std::uint32_t seed = 1;     ///< of noise, tremor, bumps and tints; what is filmed is up to `set`
  float meters_per_unit = 0.001F;
};

/// A rendered recording at 30 frames a second (`timestamp_s` = index / 30) with exact poses and instance
/// masks.
class SyntheticSource : public FrameSource {
 public:
  /// As the last frame given shows it; before the first, as it was put together.
  [[nodiscard]] virtual const SyntheticScene& scene() const = 0;
  /// Exact T_world_camera of a frame, by its `RgbdFrame::index`.
  [[nodiscard]] virtual Eigen::Isometry3d pose(int index) const = 0;
};

/// Error: no frame is left, or the intrinsics are not those of a camera.
[[nodiscard]] Result<std::unique_ptr<SyntheticSource>> makeSyntheticSource(const SyntheticOptions& options);

/// `scene`: "tabletop" (also ""), "room", "sweep", "moving", "wall" or "corridor". With ":7" appended, the
/// random scene of that seed; with ":exact", without noise; with ":uneven", with bumps on its surfaces; with
/// ":drab", in few colours; in any order. Intrinsics given in `options` are those the scene is filmed with
/// (640 x 480 stays, of colour too). Error: names the scene and those there are.
[[nodiscard]] Result<std::unique_ptr<SyntheticSource>> makeSyntheticSource(const std::string& scene,
                                                                           const SourceOptions& options);

}  // namespace scantrove
