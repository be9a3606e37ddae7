#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// Purity and completeness of what a scan put into its catalogue, with the verdict on each entry. `database`
/// empty: the scan's own.
[[nodiscard]] Result<nlohmann::ordered_json> evaluateCatalogueOf(const std::string& scan,
                                                                 const std::string& truth,
                                                                 const std::string& database);

}  // namespace scantrove
