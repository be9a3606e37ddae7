#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace scantrove {

/// Refuses an empty argument, such as an unset variable in a script. `what` names the argument.
inline CLI::Validator notEmpty(const std::string& what) {
  return {[what](const std::string& text) -> std::string {
            return text.empty() ? what + " is empty. Give a folder, a file, a camera or 'demo'" : "";
          },
          ""};
}

}  // namespace scantrove
