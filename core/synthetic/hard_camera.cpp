#include "core/synthetic/hard_camera.h"

#include "core/synthetic/hash_stream.h"
#include "core/synthetic/scene_recipe.h"

namespace scantrove::synthetic {

HardCamera makeHardCamera(std::uint32_t seed) {
  HashStream random(seed, 14100);
  HardCamera camera;
  camera.seed = seed;
  camera.depth.baseline_m = random.uniform(0.055, 0.085);
  camera.depth.lateral_sigma_px = random.uniform(0.6, 1.0);
  camera.depth.edge_dropout = random.uniform(0.35, 0.5);
  camera.depth.grazing_cosine = random.uniform(0.26, 0.36);
  camera.color_delay_s = random.uniform(0.004, 0.03);
  camera.exposure_s = random.uniform(0.05, 0.1);
  return camera;
}

void makeHard(SceneRecipe& recipe, std::uint32_t seed) {
  recipe.lights = makeRandomLights(seed, recipe.lit_center);
  recipe.camera = makeHardCamera(seed);
}

std::vector<double> colorMoments(const HardCamera& camera, std::uint32_t frame) {
  constexpr int kMoments = 7;
  const bool is_blurred = hashUniform(hashBits(frame, 14200, 1, camera.seed)) < camera.blurred_share;
  std::vector<double> moments;
  for (int i = 0; i < (is_blurred ? kMoments : 1); ++i)
    moments.push_back(camera.color_delay_s + camera.exposure_s * i / (kMoments - 1));
  return moments;
}

}  // namespace scantrove::synthetic
