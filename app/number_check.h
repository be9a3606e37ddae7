#pragma once
#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace scantrove {

/// Accepts numbers from `least` on; with `without_least`, only greater ones. Says so in words when refused.
inline CLI::Validator atLeast(double least, bool without_least = false) {
  return {[=](const std::string& text) -> std::string {
            double value = 0;
            const bool is_number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
            if (is_number && (without_least ? value > least : value >= least)) return {};
            return "'" + text + "' is not a number " + (without_least ? "above " : "from ") +
                   CLI::detail::to_string(static_cast<long>(least)) + (without_least ? "" : " on");
          },
          ""};
}

inline CLI::Validator above(double limit) { return atLeast(limit, true); }

}  // namespace scantrove
