#pragma once
#include <optional>
#include <string>

#include "core/editing/operation_log.h"

namespace scantrove {

/// Operations as text: {"kind": "join", "regions": [3, 7], ...}; empty members are left out,
/// and so are painted pixels (mask_rows.h) and what a review says (review_rows.h).
[[nodiscard]] std::string operationToJson(const Operation& operation);
[[nodiscard]] std::string effectToJson(const OperationEffect& effect);
/// None: malformed.
[[nodiscard]] std::optional<Operation> operationFromJson(const std::string& text);
[[nodiscard]] std::optional<OperationEffect> effectFromJson(const std::string& text);

}  // namespace scantrove
