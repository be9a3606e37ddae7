#pragma once
#include <cstddef>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/object_record.h"
#include "core/session/open_session.h"

namespace scantrove {

/// Crops views of a region from the key frames of a session: those that show most of it, from at most
/// `most` directions, best first. Unreadable key frames are skipped. Empty: none shows it in colour. Error:
/// the device failed. The session's thread; may throw.
[[nodiscard]] Result<std::vector<ObjectView>> viewsOfRegion(OpenSession& session, RegionId region,
                                                            std::size_t most);

}  // namespace scantrove
