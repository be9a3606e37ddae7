#pragma once
#include <functional>

#include "core/base/result.h"
#include "core/collection/frame_objects.h"
#include "core/scan/scan_event.h"
#include "core/scan/scan_parts.h"
#include "core/scan/scan_report.h"

namespace scantrove {

/// The refinement of a scan that has ended, or of a session: runs FinalPass, and keeps in the session where
/// it stopped.
class ScanRefinement {
 public:
  struct Callbacks {
    std::function<bool()> may_continue;  ///< asked before each frame
    std::function<void()> begins;        ///< there are key frames to refine with
    std::function<void(const RefinementStepped&)> stepped;
    std::function<void(const FrameObjects&)> collected;
  };

  /// What it could not find is no result that is lost: failures go to the log.
  void run(ScanParts& parts, const Callbacks& callbacks);
  /// The session of `parts` keeps what a refinement that is not done goes on with.
  void keep(ScanParts& parts) const;

  [[nodiscard]] const ScanReport::Refinement& report() const { return report_; }

 private:
  [[nodiscard]] Result<void> runPass(ScanParts& parts, const Callbacks& callbacks);

  ScanReport::Refinement report_;
};

}  // namespace scantrove
