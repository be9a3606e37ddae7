#pragma once
#include <string>

#include "core/base/ids.h"

namespace scantrove {

/// An object of the catalogue that a scan has observed.
struct CollectedObject {
  ObjectId id;
  std::string name;
  bool confirmed = false;
  int views = 0;
  std::string recognized_from;  ///< session that first added it; empty: added in this scan
};

}  // namespace scantrove
