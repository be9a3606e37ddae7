#pragma once
#include <span>

#include "core/database/migrations.h"

namespace scantrove::schema {

/// Application id "ScSe", as in 001_session.sql.
inline constexpr FileKind kSession{1399018341, "session"};

/// All steps, ascending, versions 1, 2, ...
[[nodiscard]] std::span<const Migration> sessionSteps();

}  // namespace scantrove::schema
