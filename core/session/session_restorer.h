#pragma once
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/session/session_setup.h"
#include "core/session/session_writer.h"

namespace scantrove {

/// A scan of a session, as read by the session's thread.
[[nodiscard]] Result<SavedScan> loadScan(SessionWriter& session, std::vector<std::string>& damages);

/// A scan that was interrupted before the first part of its map was stored has poses, but nothing that they
/// belong to. Then its frames become lost, so that a continued scan begins a map of its own. Result: the
/// number of these frames; 0 if a map was stored.
[[nodiscard]] int loseFramesWithoutMap(SavedScan& scan);

/// Restores a fresh pipeline (with the session's parameters and camera) to the saved state: map, labels,
/// regions with their notes, and the key frames for relocalisation. Damaged data is left out, with a
/// sentence in `damages`. `for_camera` false leaves out the key frames: the scan will not be continued.
/// Error: the device failed.
[[nodiscard]] Result<void> restoreScan(MappingPipeline& pipeline, SessionWriter& session,
                                       const SavedScan& scan, bool for_camera,
                                       std::vector<std::string>& damages);

}  // namespace scantrove
