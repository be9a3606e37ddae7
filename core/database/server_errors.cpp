#include "core/database/server_errors.h"

#include <QSqlError>
#include <QString>
#include <algorithm>
#include <vector>

#include "core/database/database_connection.h"

namespace scantrove::server {
namespace {

/// Part of libpq's or the server's text, and what it means; "%" stands for the address.
struct Reason {
  std::vector<const char*> parts;
  const char* what;
  const char* advice;
};

/// SQLSTATEs exist only for errors of statements (postgresql.org/docs/15/errcodes-appendix.html), so failed
/// connections are told apart by their text. In another language the last message of describeConnecting()
/// quotes it.
const std::vector<Reason>& reasonsOfFailedConnections() {
  static const std::vector<Reason> reasons{
      {{"could not translate host name"},
       "The host of % is not known",
       "Check the name of the host, and the network."},
      {{"no password supplied"},
       "The server of % asks for a password",
       "Put it into ~/.pgpass (mode 0600) or into PGPASSWORD, never into the address."},
      {{"password authentication failed"},
       "The server refused user or password for %",
       "Check the user in the address, and the password in ~/.pgpass (mode 0600) or PGPASSWORD."},
      {{"eer authentication failed", "no pg_hba.conf entry", "dent authentication failed"},
       "The server does not let this user in from here: %",
       "Check the user in the address, or ask the administrator for a line in pg_hba.conf."},
      {{"permission denied for database"},
       "This user may not connect to %",
       "Ask the administrator for: GRANT CONNECT ON DATABASE NAME TO USER"},
      {{"role \""}, "The server of % does not know the user", "Create the user with: createuser NAME"},
      {{"database \""}, "The server has no database for %", "Create it with: createdb NAME"},
      {{"starting up", "shutting down", "in recovery mode"},
       "The server of % is starting or stopping",
       "Wait a moment and try again."},
      {{"too many clients", "remaining connection slots"},
       "The server of % has no connection left",
       "Close other programs, or raise max_connections."},
      {{"definition of service"},
       "The service that % or PGSERVICE names is not defined",
       "Define it in ~/.pg_service.conf."},
      {{"SSL", "certificate"},
       "The encrypted connection to % failed",
       "Check sslmode and the certificates in the address."},
      {{"onnection refused", "No such file or directory", "timeout expired", "No route to host",
        "etwork is unreachable", "onnection timed out"},
       "No PostgreSQL server answers at %",
       "Start the server, or check host and port in the address."}};
  return reasons;
}

std::string textOf(const QSqlError& error) {
  const QString text = error.databaseText().simplified();
  return (text.isEmpty() ? error.driverText().simplified() : text).toStdString();
}

std::string withAddress(std::string text, const std::string& url) {
  if (const std::size_t at = text.find('%'); at != std::string::npos) text.replace(at, 1, url);
  return text;
}

}  // namespace

Failure failureOf(const QSqlError& error) {
  const QString code = error.nativeErrorCode();
  if (code == QLatin1String("40001") || code == QLatin1String("40P01")) return Failure::conflict;
  // The server ended the connection, or libpq found it closed and has no code.
  const bool is_lost = code.isEmpty() || code.startsWith(QLatin1String("08")) ||
                       code.startsWith(QLatin1String("57P")) || code == QLatin1String("25P03");
  return is_lost ? Failure::lost : Failure::refused;
}

Error describeConnecting(const std::string& url, const QSqlError& error) {
  const std::string text = textOf(error);
  for (const Reason& reason : reasonsOfFailedConnections()) {
    if (std::ranges::any_of(reason.parts,
                            [&](const char* part) { return text.find(part) != std::string::npos; }))
      return {withAddress(reason.what, url) + " (" + text + ").", reason.advice};
  }
  return {"Cannot connect to " + url + " (" + text + ").",
          "Check the address, the server, and your rights there."};
}

Error describe(const std::string& url, const QSqlError& error) {
  const std::string text = textOf(error);
  const std::string code = error.nativeErrorCode().toStdString();
  switch (failureOf(error)) {
    case Failure::conflict:
      return {"Other programs changed " + url + " at the same time (" + text + ").", "Try again."};
    case Failure::lost:
      return {"The connection to " + url + " is lost (" + text + ").",
              "It is made again as soon as the server answers."};
    case Failure::refused:
      break;
  }
  if (code == "55P03") {
    return {"The database " + url + " is locked by another program (waited 5 s).",
            "Wait until that program is done."};
  }
  if (code == "42501") {
    return {"You may not do this in the database " + url + " (" + text + ").",
            "Ask the administrator for the rights to create and change its tables."};
  }
  if (code == "25006") {
    return {"The database " + url + " cannot be written (" + text + ").",
            "Use the main server, not a copy that only reads."};
  }
  if (code == "53100")
    return {"The disk of the server is full: " + url + " could not be written.", "Free some space there."};
  if (code == "42P01" || code == "42703") return damagedDatabase(url, text);
  return {"The database " + url + " refused an operation (" + text + ").", "Check the server and its log."};
}

}  // namespace scantrove::server
