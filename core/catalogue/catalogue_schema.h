#pragma once
#include <span>

#include "core/database/migrations.h"

namespace scantrove::schema {

/// Application id "Scnt", as in 001_initial.sql.
inline constexpr FileKind kCatalogue{1399025268, "catalogue"};

/// All steps, ascending, versions 1, 2, ...
[[nodiscard]] std::span<const Migration> catalogueSteps();

}  // namespace scantrove::schema
