#pragma once
#include <string>
#include <vector>

#include "core/dataset/dataset_export.h"

namespace scantrove {

/// The frames of a data set by their review, before unfit ones are sorted out.
struct FrameChoice {
  std::vector<KeyFrameInfo> frames;  ///< in order of time
  int left_out = 0;                  ///< by a person
  int unchecked = 0;                 ///< not checked, with ExportOptions::checked_only

  /// The missing frames in a sentence; empty: none is missing.
  [[nodiscard]] std::string missing() const;
};

/// The one place where frames are chosen by their review: frames that a person left out are in no data set.
/// With checked_only exactly the checked ones are, also such as show the same as others. Error: as for
/// LabeledScan::keyFrames.
[[nodiscard]] Result<FrameChoice> chooseFrames(LabeledScan& scan, const ExportOptions& options);

}  // namespace scantrove
