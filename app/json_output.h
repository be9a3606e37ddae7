#pragma once
#include <iostream>
#include <nlohmann/json.hpp>

namespace scantrove {

using Json = nlohmann::ordered_json;  ///< keeps the order of the keys, for human readers

/// Prints to stdout, indented by one. Replaces invalid UTF-8 in names, so that the output is always valid
/// JSON.
inline void printJson(const Json& json) {
  std::cout << json.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace scantrove
