#pragma once
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace scantrove {

/// A database of a PostgreSQL server as a URL names it:
///     postgresql://[USER@][HOST][:PORT][/DATABASE][?OPTION=VALUE&...]
/// Empty parts are libpq's defaults (PGHOST, PGSERVICE, ...). `?host=/FOLDER` names a UNIX socket. It never
/// holds a password: libpq takes that from PGPASSWORD, ~/.pgpass or a service.
struct ServerAddress {
  std::string host, user, database;
  int port = -1;        ///< -1: libpq's default
  std::string options;  ///< the other options, as QSqlDatabase::setConnectOptions takes them
};

/// Whether a `--database` names a server rather than a file. Any thread, like the following.
[[nodiscard]] bool isServerAddress(std::string_view database);

/// Error: a password in it, an unknown option, or no such URL. A message never repeats a password.
[[nodiscard]] Result<ServerAddress> serverAddressFrom(const std::string& url);

/// Refuses addresses that serverAddressFrom() refuses, and takes every name of a file.
[[nodiscard]] Result<void> checkCatalogueName(const std::string& database);

/// For messages and records: `database` without a password, if somebody wrote one into an address.
[[nodiscard]] std::string withoutPassword(const std::string& database);

}  // namespace scantrove
