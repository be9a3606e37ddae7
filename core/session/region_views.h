#pragma once
#include <cstddef>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/object_record.h"
#include "core/session/open_session.h"

namespace scantrove {

/// Views of a region cut from the key frames of a session: those that show most of it, from at most `most`
/// directions, the best one first. Key frames that cannot be read are passed over. Empty: none shows it in
/// colour. Error: the device failed. The thread of the session; may throw.
[[nodiscard]] Result<std::vector<ObjectView>> viewsOfRegion(OpenSession& session, RegionId region,
                                                            std::size_t most);

}  // namespace scantrove
