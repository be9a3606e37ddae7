#pragma once
#include <cstdint>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// What copyCatalogue() has copied.
struct CatalogueCopy {
  std::int64_t objects = 0;  ///< visible ones
  std::int64_t views = 0, classes = 0, events = 0;
};

/// Copies a whole catalogue into an empty one, from a file or a server to a file or a server: objects, views
/// byte for byte, classes, sessions, history, all ids, and the identity, so that saved scans find their
/// objects in the copy. `to` is created if it is missing; all is one transaction there. `from` stays as it is
/// and may be in use. Error: `to` holds objects, classes or history; `from` is missing or has an older
/// schema; either cannot be read or written. Nothing is copied then.
[[nodiscard]] Result<CatalogueCopy> copyCatalogue(const std::string& from, const std::string& to);

}  // namespace scantrove
