#pragma once
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/session/session_setup.h"
#include "core/session/session_writer.h"

namespace scantrove {

/// A scan of a session, read back by the session's thread.
[[nodiscard]] Result<SavedScan> loadScan(SessionWriter& session, std::vector<std::string>& damages);

/// Makes a fresh pipeline (of the session's parameters and camera) what it was when the session was saved:
/// map, labels, regions, what was said of them, and the places by which a camera finds its way back. What is
/// damaged is left out, with a sentence in `damages`. With `for_camera` false the places are left out: it is
/// not to be scanned on. Error: the device failed.
[[nodiscard]] Result<void> restoreScan(MappingPipeline& pipeline, SessionWriter& session,
                                       const SavedScan& scan, bool for_camera,
                                       std::vector<std::string>& damages);

}  // namespace scantrove
