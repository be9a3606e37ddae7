#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/catalogue_mirror.h"
#include "core/collection/identity_resolver.h"
#include "core/collection/object_tracks.h"
#include "core/collection/recognizer.h"
#include "core/collection/stored_view.h"
#include "core/collection/user_requests.h"

namespace scantrove {

/// The state of an ObjectCollector besides map, regions and catalogue, as plain data. A collector made with
/// it continues the refinement of a scan in another run of the program without a difference.
struct CollectorState {
  CatalogueMirror::Continued catalogue;
  std::int64_t last_event = 0;  ///< newest event of the catalogue that was read
  ObjectTracks::State tracks;
  Recognizer::State recognizer;
  UserRequests::State requests;
  IdentityResolver::State identities;
  std::vector<StoredView> views;
  bool is_refining = false;
  bool is_last_pass = false;
  int frame = 0;
};

/// Serializes for the session.
[[nodiscard]] std::vector<std::uint32_t> collectorMemory(const CollectorState& state);
/// None: the words are damaged or of a later version.
[[nodiscard]] std::optional<CollectorState> collectorStateFrom(std::span<const std::uint32_t> words);

/// Error: the `catalogue` lacks objects that the scan added to it. `catalogue` must be loaded.
[[nodiscard]] Result<void> checkObjects(const CollectorState& state, const CatalogueMirror& catalogue);

}  // namespace scantrove
