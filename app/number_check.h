#pragma once
#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

namespace scantrove {

/// Accepts decimal integers from `least` on that fit into an int. Removes leading zeros ("000500", as in
/// frame names), which CLI11 would read as octal.
inline CLI::Validator wholeNumber(int least) {
  return {[least](std::string& text) -> std::string {
            int value = 0;
            const char* const end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(text.data(), end, value);
            if (error != std::errc() || stop != end || value < least) {
              return "'" + text + "' is not a whole number from " + std::to_string(least) + " to " +
                     std::to_string(std::numeric_limits<int>::max());
            }
            text = std::to_string(value);
            return {};
          },
          ""};
}

/// Accepts finite numbers from `least` on; with `without_least`, only greater ones.
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
