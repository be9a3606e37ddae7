#pragma once

namespace scantrove {

/// Constraint between two fragments; overrides evidence.
enum class LinkConstraint {
  none,
  must_link,   ///< both belong to one object
  cannot_link  ///< they belong to different objects
};

}  // namespace scantrove
