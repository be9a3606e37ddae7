#include "core/tracking/surface_aligner.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "core/base/check.h"

namespace scantrove {
namespace {

// From the finest level to the coarsest; pyramids with fewer levels use the first entries.
constexpr std::array<int, 3> kPasses{6, 8, 14};
constexpr std::array<float, 3> kDistance_m{0.05F, 0.07F, 0.10F};  // IcpGates::distance_m
// A level has converged when a step is smaller than this, in radians and metres.
constexpr std::array<double, 3> kSmallStep{1e-4, 2e-4, 4e-4};
// Readings that change their partner with every pass make the pose oscillate. When a step does not shrink to
// this part of the one before, all further steps are halved, and so again.
constexpr double kShrinking = 0.7;
constexpr double kSmallestShare = 0.25;  // smaller steps would hardly move the pose
// Closer guesses lead to the same pose.
constexpr double kSameGuess_rad = 0.005;
constexpr double kSameGuess_m = 0.005;
// alignTurned() turns the camera this far about each axis.
constexpr double kSearch_rad = 0.10;

Eigen::Isometry3d withExactRotation(Eigen::Isometry3d T) {
  T.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  return T;
}

bool isSameGuess(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Eigen::Isometry3d motion = a.inverse() * b;
  return Eigen::AngleAxisd(motion.linear()).angle() < kSameGuess_rad &&
         motion.translation().norm() < kSameGuess_m;
}

/// Mean squared distance over the frame's readings. A reading that contradicts the model counts with the
/// squared gate, and one that does not meet it with half of that.
double costOf(const IcpSystem& system, double gate_m) {
  if (system.readings == 0) return 0;
  const double contradicting = system.overlap - system.inliers;
  const double unmet = system.readings - system.overlap;
  return (system.squared_error + (contradicting + 0.5 * unmet) * gate_m * gate_m) / system.readings;
}

std::size_t coarsestOf(const DepthPyramid& frame) {
  SCANTROVE_CHECK(!frame.levels.empty());
  return std::min(frame.levels.size(), kPasses.size()) - 1;
}

}  // namespace

Result<std::unique_ptr<SurfaceAligner>> SurfaceAligner::create(ComputeContext& compute, float depth_noise_m) {
  Result<IcpPass> pass = IcpPass::create(compute);
  if (!pass) return fail(pass.error());
  return std::unique_ptr<SurfaceAligner>(new SurfaceAligner(std::move(*pass), depth_noise_m));
}

IcpOutcome SurfaceAligner::alignWith(const Terms& terms, const DepthPyramid& frame, const SurfaceMaps& model,
                                     std::span<const Eigen::Isometry3d> guesses) {
  SCANTROVE_CHECK(!guesses.empty());
  const std::size_t coarsest = coarsestOf(frame);
  const auto gate = static_cast<double>(kDistance_m[coarsest]);
  IcpOutcome best = descend(frame, model, guesses.front(), coarsest, terms);
  // If the surface fits but leaves directions free, all guesses fit alike, and the first is kept.
  const bool is_silent = best.step.free_directions > 0 && 2 * best.system.inliers > best.system.overlap;
  for (std::size_t i = 1; i < guesses.size() && !is_silent; ++i) {
    const auto is_tried = [&](const Eigen::Isometry3d& tried) { return isSameGuess(tried, guesses[i]); };
    if (std::ranges::any_of(guesses.first(i), is_tried)) continue;
    IcpOutcome outcome = descend(frame, model, guesses[i], coarsest, terms);
    if (costOf(outcome.system, gate) < costOf(best.system, gate)) best = std::move(outcome);
  }
  return refine(frame, model, std::move(best), coarsest, terms);
}

IcpOutcome SurfaceAligner::alignTurned(const DepthPyramid& frame, const SurfaceMaps& model) {
  constexpr Terms kTerms{nullptr, kSmallestEigenvalue};
  const std::size_t coarsest = coarsestOf(frame);
  const auto gate = static_cast<double>(kDistance_m[coarsest]);
  IcpOutcome best;
  double best_cost = std::numeric_limits<double>::max();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double angle_rad : {-kSearch_rad, kSearch_rad}) {
      const Eigen::Isometry3d turn(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::Unit(axis)));
      IcpOutcome outcome = descend(frame, model, model.T_world_camera * turn, coarsest, kTerms);
      const double cost = costOf(outcome.system, gate);
      if (cost >= best_cost) continue;
      best_cost = cost;
      best = std::move(outcome);
    }
  }
  return refine(frame, model, std::move(best), coarsest, kTerms);
}

IcpOutcome SurfaceAligner::descend(const DepthPyramid& frame, const SurfaceMaps& model,
                                   const Eigen::Isometry3d& guess, std::size_t level, const Terms& terms) {
  IcpOutcome outcome{
      .T_world_camera = guess, .system = {}, .step = {}, .pixels = frame.levels[level].K.pixels()};
  const IcpGates gates = IcpGates::of(kDistance_m[level], depth_noise_m_);
  double share = 1;
  double last_step = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kPasses[level]; ++i) {
    outcome.system = pass_.run(frame.levels[level], model, outcome.T_world_camera, gates);
    LandmarkTerm term;
    if (terms.landmarks != nullptr)
      term = LandmarkTerm::of(*terms.landmarks, outcome.T_world_camera, outcome.system.center);
    outcome.step =
        solveIcp(outcome.system, terms.smallest_eigenvalue, terms.landmarks != nullptr ? &term : nullptr);
    if (!outcome.step.finite) break;
    const double step = std::max(outcome.step.rotation_rad, outcome.step.translation_m);
    if (step > kShrinking * last_step) share = std::max(share / 2, kSmallestShare);
    last_step = step;
    if (share < 1) outcome.step = outcome.step.part(share, outcome.system.center);
    outcome.T_world_camera = outcome.step.motion * outcome.T_world_camera;
    if (share * step < kSmallStep[level]) break;
  }
  return outcome;
}

IcpOutcome SurfaceAligner::refine(const DepthPyramid& frame, const SurfaceMaps& model, IcpOutcome coarse,
                                  std::size_t coarsest, const Terms& terms) {
  IcpOutcome outcome = std::move(coarse);
  for (std::size_t level = coarsest; level > 0; --level) {
    outcome = descend(frame, model, outcome.T_world_camera, level - 1, terms);
  }
  outcome.T_world_camera = withExactRotation(outcome.T_world_camera);
  if (terms.landmarks != nullptr)
    outcome.landmark_error_px = terms.landmarks->errorPx(outcome.T_world_camera);
  return outcome;
}

}  // namespace scantrove
