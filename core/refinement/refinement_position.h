#pragma once

namespace scantrove {

/// The progress of a refinement.
struct RefinementPosition {
  enum class Pass { segment, rate, judge, collect, complete, compare_views, store_views, done };
  Pass pass = Pass::segment;
  int frames = 0;  ///< done in this pass

  bool operator==(const RefinementPosition&) const = default;
};

}  // namespace scantrove
