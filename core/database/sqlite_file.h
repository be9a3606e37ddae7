#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "core/base/result.h"

class QSqlError;

namespace scantrove::sqlite {

/// Checks the path of a database to be opened or created. Even reading the header is left to SQLite; the
/// class comment of ObjectDatabase says why.
[[nodiscard]] Result<void> checkPath(const std::string& file);
/// Checks a file that is only read.
[[nodiscard]] Result<void> checkReadable(const std::string& file);

/// What SQLite's error means for the user of `file`.
[[nodiscard]] Error describe(const std::string& file, const QSqlError& error);

/// State of a file that reveals changes without opening it.
struct Stamp {
  std::int64_t bytes = 0, seconds = 0, nanoseconds = 0;
  std::uint64_t inode = 0;
  bool operator==(const Stamp&) const = default;
};
/// None: somebody is writing to it, or may have been interrupted.
[[nodiscard]] std::optional<Stamp> stampOf(const std::string& file);

}  // namespace scantrove::sqlite
