#pragma once
#include <span>

#include "core/evaluation/error_summary.h"
#include "core/evaluation/trajectory_alignment.h"

namespace scantrove {

/// Absolute trajectory error (Sturm et al. 2012; evo's `ape ... -a`): distances in metres between true
/// positions and estimated ones after the rigid alignment without scale.
[[nodiscard]] ErrorSummary absoluteTrajectoryError(std::span<const PosePair> pairs);

/// Relative pose error (Sturm et al. 2012; evo's `rpe -d delta -u f --all_pairs`).
struct RelativePoseError {
  ErrorSummary translation_m;
  ErrorSummary rotation_deg;
};

/// Over all i: E = (Q_i^-1 Q_{i+delta})^-1 (P_i^-1 P_{i+delta}), Q true, P estimated; |trans(E)| and the
/// angle of E. `delta_frames` counts pairs, at least 1.
[[nodiscard]] RelativePoseError relativePoseError(std::span<const PosePair> pairs, int delta_frames = 1);

}  // namespace scantrove
