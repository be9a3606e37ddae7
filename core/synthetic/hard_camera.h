#pragma once
#include <cstdint>
#include <vector>

#include "core/synthetic/kinect_noise.h"

namespace scantrove::synthetic {

struct SceneRecipe;

/// A camera with failures of real ones: besides the noise of KinectModel it loses the depth of shiny, dark
/// and transparent surfaces, blurs some frames, and takes colour and depth at different moments.
struct HardCamera {
  KinectModel depth;
  double color_delay_s = 0;     ///< colour is exposed this long after depth
  double blurred_share = 0.12;  ///< share of frames with a long exposure; others have none
  double exposure_s = 0.07;     ///< of a blurred frame
  std::uint32_t seed = 1;       ///< selects the blurred frames
};

/// A camera with a delay of 4 - 30 ms and exposures of 50 - 100 ms.
[[nodiscard]] HardCamera makeHardCamera(std::uint32_t seed);

/// Gives a scene the camera and the lights of `seed`. `recipe.lit_center` is set.
void makeHard(SceneRecipe& recipe, std::uint32_t seed);

/// Moments of the colour exposure, in seconds after depth: one, or several evenly spaced ones of a blurred
/// frame.
[[nodiscard]] std::vector<double> colorMoments(const HardCamera& camera, std::uint32_t frame);

}  // namespace scantrove::synthetic
