#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// Purity and completeness of the objects that a scan added to its catalogue, and a verdict for each entry.
/// If `database` is empty, uses the scan's own catalogue.
[[nodiscard]] Result<nlohmann::ordered_json> evaluateCatalogueOf(const std::string& scan,
                                                                 const std::string& truth,
                                                                 const std::string& database);

}  // namespace scantrove
