#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/capture/intrinsics.h"

namespace scantrove {

class DatabaseConnection;

/// The scans that added to a catalogue (table `sessions`).
class CatalogueSessions {
 public:
  CatalogueSessions(DatabaseConnection& connection, bool has_cameras)
      : connection_(connection), has_cameras_(has_cameras) {}

  /// `camera`: of the depth images of its views, if known.
  [[nodiscard]] Result<std::int64_t> begin(const std::string& source,
                                           const std::optional<Intrinsics>& camera = std::nullopt);
  [[nodiscard]] Result<void> end(std::int64_t session);
  /// The depth camera of each session, where known.
  [[nodiscard]] Result<std::map<std::int64_t, Intrinsics>> cameras();
  /// Whether a session began within ten minutes of `begun` (ISO 8601, UTC).
  [[nodiscard]] Result<bool> hasScanOf(const std::string& begun);

 private:
  DatabaseConnection& connection_;
  bool has_cameras_;  // according to the schema version
};

}  // namespace scantrove
