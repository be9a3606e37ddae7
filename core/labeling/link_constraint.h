#pragma once

namespace scantrove {

/// What was said of two fragments, whatever is seen.
enum class LinkConstraint {
  none,
  must_link,   ///< they are of one thing
  cannot_link  ///< they are of two
};

}  // namespace scantrove
