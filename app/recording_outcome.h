#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/json_output.h"
#include "core/base/result.h"

namespace scantrove {

/// What became of one recording of `project scan`.
struct RecordingOutcome {
  enum class Kind {
    done,     ///< scanned to its end
    stopped,  ///< its results are written; the next run continues it
    skipped,  ///< `reason`: scanned before, or another program scans it now
    failed,   ///< `reason`
    left,     ///< not begun, because the command was stopped
  };
  std::string source;
  Kind kind = Kind::left;
  std::string reason;         ///< a sentence; empty where there is none
  std::string scan;           ///< the folder's name in the project; empty: none
  bool is_continued = false;  ///< an earlier, stopped scan went on
  int read = 0, tracked = 0;  ///< frames
  int regions = 0, objects = 0;
};

[[nodiscard]] Json toJson(const RecordingOutcome& outcome);
/// Empty: not what toJson() made.
[[nodiscard]] std::optional<RecordingOutcome> outcomeFrom(const Json& json);

/// One line for stdout: "scanned  kitchen: 120 of 120 frames tracked, 14 regions, 6 objects".
[[nodiscard]] std::string toLine(const RecordingOutcome& outcome);

/// All outcomes of a command: {"done", "stopped", "skipped", "failed", "left", "recordings": [...]}.
[[nodiscard]] Json toJson(const std::vector<RecordingOutcome>& outcomes);
/// Lines for stdout: the failures again, then the counts.
[[nodiscard]] std::string toSummary(const std::vector<RecordingOutcome>& outcomes);

/// Error: some recordings failed. The only one of a command gives its own reason.
[[nodiscard]] Result<void> checkOutcomes(const std::vector<RecordingOutcome>& outcomes);

}  // namespace scantrove
