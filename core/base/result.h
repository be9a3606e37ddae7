#pragma once
#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace scantrove {

/// A failure of the world (file, device, database, camera) in words for the person at the screen:
/// what happened and to what, and what to do about it.
struct Error {
  std::string what;    ///< one sentence that names the file, device or value
  std::string advice;  ///< what the person can do; may be empty

  /// "what advice", ready to show.
  [[nodiscard]] std::string message() const { return advice.empty() ? what : what + " " + advice; }
};

template <class T>
using Result = tl::expected<T, Error>;

/// `return fail("Cannot open x.", "Check the path.");`
[[nodiscard]] inline tl::unexpected<Error> fail(std::string what, std::string advice = {}) {
  return tl::unexpected<Error>(Error{std::move(what), std::move(advice)});
}

/// Hands a failure on to the caller: `return fail(result.error());`
[[nodiscard]] inline tl::unexpected<Error> fail(Error error) {
  return tl::unexpected<Error>(std::move(error));
}

/// Moves what `result` holds into `target`; a failure is handed on:
/// `SCANTROVE_TRY(moveInto(member_, Thing::create()));`
template <class Target, class Value>
[[nodiscard]] Result<void> moveInto(Target& target, Result<Value> result) {
  if (!result) return fail(std::move(result).error());
  target = std::move(*result);
  return {};
}

}  // namespace scantrove

/// Leaves the current function with the error of a `Result<void>`-like expression that failed.
#define SCANTROVE_TRY(expression)                                                       \
  do {                                                                                  \
    if (auto scantrove_result = (expression); !scantrove_result) {                      \
      return ::tl::unexpected<::scantrove::Error>(std::move(scantrove_result).error()); \
    }                                                                                   \
  } while (false)
