#pragma once
#include <functional>

#include "core/base/result.h"
#include "core/collection/frame_objects.h"
#include "core/scan/scan_event.h"
#include "core/scan/scan_parts.h"
#include "core/scan/scan_report.h"

namespace scantrove {

/// The refinement of an ended scan or of a session: runs FinalPass, and stores in the session where it
/// stopped.
class ScanRefinement {
 public:
  struct Callbacks {
    std::function<bool()> may_continue;  ///< asked before each frame
    std::function<void()> begins;        ///< called if there are key frames
    std::function<void(const RefinementStepped&)> stepped;
    std::function<void(const FrameObjects&)> collected;
  };

  /// Failures go to the log: refinement only adds to the results.
  void run(ScanParts& parts, const Callbacks& callbacks);
  /// Stores the memory of an unfinished refinement in the session of `parts`.
  void keep(ScanParts& parts) const;

  [[nodiscard]] const ScanReport::Refinement& report() const { return report_; }

 private:
  [[nodiscard]] Result<void> runPass(ScanParts& parts, const Callbacks& callbacks);

  ScanReport::Refinement report_;
};

}  // namespace scantrove
