#pragma once
#include <optional>
#include <string>

#include "core/base/ids.h"

namespace scantrove {

/// An object of the catalogue that a scan has observed.
struct CollectedObject {
  ObjectId id;
  std::string name;
  bool confirmed = false;
  int views = 0;
  std::string recognized_from;           ///< session that first added it; empty: added in this scan
  std::optional<float> objectness = {};  ///< log-odds by the refinement; none: not rated
};

}  // namespace scantrove
