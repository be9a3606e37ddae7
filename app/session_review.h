#pragma once
#include "app/session_arguments.h"

namespace scantrove {

/// `session review`: sets the state of key frames, or lists all.
[[nodiscard]] Result<void> reviewKeyFrames(OpenSession& session, const SessionArguments& arguments);

}  // namespace scantrove
