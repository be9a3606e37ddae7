#pragma once
#include <string>

#include "core/base/result.h"
#include "core/capture/intrinsics.h"
#include "core/scan/scan_params.h"
#include "core/session/saved_scan.h"

namespace scantrove {

/// What a session was scanned with.
struct SessionSetup {
  std::string source;
  Intrinsics K;  ///< of the recording's depth images
  ScanParams params;
  std::string database;  ///< relative to the session's folder where it lies in it
};

/// As facts, and back. Error: they are not those of a session.
[[nodiscard]] SavedFacts factsOf(const SessionSetup& setup);
[[nodiscard]] Result<SessionSetup> setupFrom(const SavedFacts& facts);

}  // namespace scantrove
