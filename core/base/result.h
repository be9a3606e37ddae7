#pragma once
#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace scantrove {

/// A runtime failure (file, device, database, camera), in words for the user: what happened to which thing,
/// and what to do about it.
struct Error {
  std::string what;    ///< one sentence that names the file, device or value
  std::string advice;  ///< what the user can do; may be empty

  /// "what advice", for display.
  [[nodiscard]] std::string message() const { return advice.empty() ? what : what + " " + advice; }
};

template <class T>
using Result = tl::expected<T, Error>;

/// `return fail("Cannot open x.", "Check the path.");`
[[nodiscard]] inline tl::unexpected<Error> fail(std::string what, std::string advice = {}) {
  return tl::unexpected<Error>(Error{std::move(what), std::move(advice)});
}

/// Passes a failure to the caller: `return fail(result.error());`
[[nodiscard]] inline tl::unexpected<Error> fail(Error error) {
  return tl::unexpected<Error>(std::move(error));
}

/// Moves the value of `result` into `target`, or returns its failure: `SCANTROVE_TRY(moveInto(member_,
/// Thing::create()));`
template <class Target, class Value>
[[nodiscard]] Result<void> moveInto(Target& target, Result<Value> result) {
  if (!result) return fail(std::move(result).error());
  target = std::move(*result);
  return {};
}

}  // namespace scantrove

/// Returns from the current function with the error of a failed `Result<void>`-like expression.
#define SCANTROVE_TRY(expression)                                                       \
  do {                                                                                  \
    if (auto scantrove_result = (expression); !scantrove_result) {                      \
      return ::tl::unexpected<::scantrove::Error>(std::move(scantrove_result).error()); \
    }                                                                                   \
  } while (false)
