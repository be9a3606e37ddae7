#pragma once

namespace scantrove {

/// How far a refinement has come.
struct RefinementPosition {
  enum class Pass { segment, rate, judge, collect, complete, done };
  Pass pass = Pass::segment;
  int frames = 0;  ///< of this pass that are done

  bool operator==(const RefinementPosition&) const = default;
};

}  // namespace scantrove
