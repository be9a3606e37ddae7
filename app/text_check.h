#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace scantrove {

/// Refuses an empty text, as an unset variable of a script gives it. `what` names the argument.
inline CLI::Validator notEmpty(const std::string& what) {
  return {[what](const std::string& text) -> std::string {
            return text.empty() ? what + " is empty. Give a folder, a file, a camera or 'demo'" : "";
          },
          ""};
}

}  // namespace scantrove
