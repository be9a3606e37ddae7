#include "core/evaluation/trajectory_metrics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/check.h"

namespace scantrove {

ErrorSummary summarizeErrors(std::vector<double> errors) {
  if (errors.empty()) return {};
  std::sort(errors.begin(), errors.end());
  const double count = static_cast<double>(errors.size());
  ErrorSummary summary;
  double squares = 0;
  for (const double error : errors) {
    summary.mean += error / count;
    squares += error * error;
  }
  summary.rmse = std::sqrt(squares / count);
  const std::size_t middle = errors.size() / 2;
  summary.median = errors.size() % 2 == 1 ? errors[middle] : 0.5 * (errors[middle - 1] + errors[middle]);
  summary.max = errors.back();
  summary.count = static_cast<int>(errors.size());
  return summary;
}

ErrorSummary absoluteTrajectoryError(std::span<const PosePair> pairs) {
  const Eigen::Isometry3d T_truth_estimate = alignRigidly(pairs);
  std::vector<double> errors_m;
  for (const PosePair& pair : pairs) {
    const Eigen::Vector3d aligned = T_truth_estimate * pair.estimate.T_world_camera.translation();
    errors_m.push_back((pair.truth.T_world_camera.translation() - aligned).norm());
  }
  return summarizeErrors(std::move(errors_m));
}

RelativePoseError relativePoseError(std::span<const PosePair> pairs, int delta_frames) {
  SCANTROVE_CHECK(delta_frames >= 1);
  const auto delta = static_cast<std::size_t>(delta_frames);
  std::vector<double> translations_m;
  std::vector<double> rotations_deg;
  for (std::size_t i = 0; i + delta < pairs.size(); ++i) {
    const auto motion = [&](const StampedPose& from, const StampedPose& to) {
      return from.T_world_camera.inverse() * to.T_world_camera;
    };
    const Eigen::Isometry3d error = motion(pairs[i].truth, pairs[i + delta].truth).inverse() *
                                    motion(pairs[i].estimate, pairs[i + delta].estimate);
    translations_m.push_back(error.translation().norm());
    rotations_deg.push_back(Eigen::AngleAxisd(error.rotation()).angle() * 180.0 / std::numbers::pi);
  }
  return {summarizeErrors(std::move(translations_m)), summarizeErrors(std::move(rotations_deg))};
}

}  // namespace scantrove
