#pragma once
#include <string>

#include "core/base/result.h"

class QSqlError;

namespace scantrove::server {

/// What a statement's failure means for the connection.
enum class Failure {
  refused,   ///< the statement; the connection goes on
  conflict,  ///< with another transaction: the same transaction may be tried again
  lost       ///< the connection; nothing of the open transaction is stored
};
[[nodiscard]] Failure failureOf(const QSqlError& error);

/// Why no connection to `url` was made, and what to do.
[[nodiscard]] Error describeConnecting(const std::string& url, const QSqlError& error);
/// Why a statement failed, and what to do.
[[nodiscard]] Error describe(const std::string& url, const QSqlError& error);

}  // namespace scantrove::server
