#pragma once
#include <iostream>
#include <nlohmann/json.hpp>

namespace scantrove {

using Json = nlohmann::ordered_json;  ///< keys stay as they were written: people read this, too

/// To stdout, indented by one. What is not UTF-8 in a name is replaced: a script gets JSON whatever a file
/// holds.
inline void printJson(const Json& json) {
  std::cout << json.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace scantrove
