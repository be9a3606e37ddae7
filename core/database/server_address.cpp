#include "core/database/server_address.h"

#include <QString>
#include <QStringList>
#include <QUrl>
#include <QUrlQuery>
#include <algorithm>
#include <array>
#include <string_view>

namespace scantrove {
namespace {

constexpr std::array kServerSchemes{std::string_view("postgresql://"), std::string_view("postgres://")};

/// Options that are handed to libpq as they are.
constexpr std::array kServerOptions{"sslmode",    "sslrootcert", "sslcert", "sslkey",
                                    "gssencmode", "passfile",    "service"};

constexpr const char* kAddressForm =
    "Write postgresql://USER@HOST:PORT/DATABASE, or postgresql:///DATABASE?host=/FOLDER for a local socket.";

tl::unexpected<Error> passwordRefused() {
  return fail("The address of the catalogue holds a password. Others could read it, so it is not used.",
              "Leave it out of the address, and put it into ~/.pgpass (mode 0600) or into PGPASSWORD.");
}

/// libpq's quotes.
QString quoted(QString value) {
  value.replace(u'\\', QStringLiteral("\\\\")).replace(u'\'', QStringLiteral("\\'"));
  return u'\'' + value + u'\'';
}

/// Where user and host begin; npos: this is no address of a server.
std::size_t authorityAt(std::string_view url) {
  const auto scheme = std::ranges::find_if(kServerSchemes, [&](auto one) { return url.starts_with(one); });
  return scheme == kServerSchemes.end() ? std::string_view::npos : scheme->size();
}

/// Takes one option of the URL.
Result<void> takeOption(ServerAddress& address, const QString& name, const QString& value) {
  if (name == QStringLiteral("password")) return passwordRefused();
  if (name == QStringLiteral("host")) {
    address.host = value.toStdString();
  } else if (name == QStringLiteral("user")) {
    address.user = value.toStdString();
  } else if (name == QStringLiteral("dbname")) {
    address.database = value.toStdString();
  } else if (name == QStringLiteral("port")) {
    bool is_number = false;
    address.port = value.toInt(&is_number);
    if (!is_number || address.port < 1 || address.port > 65535)
      return fail("The port in the address of the catalogue is not a number from 1 to 65535.", kAddressForm);
  } else if (std::ranges::any_of(kServerOptions,
                                 [&](const char* one) { return name == QLatin1String(one); })) {
    // QtSql takes a semicolon as the end of an option.
    if (value.contains(u';')) {
      return fail("The option " + name.toStdString() + " in the address of the catalogue has a semicolon.",
                  "Give another name to what it stands for.");
    }
    if (!address.options.empty()) address.options += ';';
    address.options += (name + u'=' + quoted(value)).toStdString();
  } else {
    QStringList known{QStringLiteral("host"), QStringLiteral("port"), QStringLiteral("user"),
                      QStringLiteral("dbname")};
    for (const char* one : kServerOptions) known.push_back(QLatin1String(one));
    return fail("The address of the catalogue has an unknown option.",
                "Known are " + known.join(QStringLiteral(", ")).toStdString() + ".");
  }
  return {};
}

}  // namespace

bool isServerAddress(std::string_view database) {
  return std::ranges::any_of(kServerSchemes, [&](auto scheme) { return database.starts_with(scheme); });
}

Result<ServerAddress> serverAddressFrom(const std::string& url) {
  // First of all, because QUrl may reject an address only for the letters of its password.
  if (withoutPassword(url) != url) return passwordRefused();
  const QUrl parsed(QString::fromStdString(url), QUrl::StrictMode);
  // The message does not repeat the address, because a password in it may be what makes it invalid.
  if (!isServerAddress(url) || !parsed.isValid() || parsed.hasFragment())
    return fail("The address of the catalogue is not complete or has a wrong letter.", kAddressForm);
  ServerAddress address;
  address.host = parsed.host(QUrl::FullyDecoded).toStdString();
  address.user = parsed.userName(QUrl::FullyDecoded).toStdString();
  address.port = parsed.port();
  address.database = parsed.path(QUrl::FullyDecoded).mid(1).toStdString();
  for (const auto& [name, value] : QUrlQuery(parsed).queryItems(QUrl::FullyDecoded))
    SCANTROVE_TRY(takeOption(address, name, value));
  return address;
}

Result<void> checkCatalogueName(const std::string& database) {
  if (!isServerAddress(database)) return {};
  const Result<ServerAddress> address = serverAddressFrom(database);
  return address ? Result<void>() : fail(address.error());
}

std::string withoutPassword(const std::string& database) {
  const std::size_t begin = authorityAt(database);
  if (begin == std::string::npos) return database;
  const std::size_t query = std::min(database.find('?', begin), database.size());
  std::string url = database.substr(0, query);
  // Unescaped passwords may hold '@' and '/'.
  const std::size_t user_end = url.rfind('@'), colon = url.find_first_of(":/", begin);
  if (user_end != std::string::npos && colon < user_end && url[colon] == ':')
    url.erase(colon, user_end - colon);
  char separator = '?';
  for (std::size_t from = query; from < database.size();) {
    const std::size_t next = std::min(database.find('&', from + 1), database.size());
    const std::string option = database.substr(from + 1, next - from - 1);
    from = next;
    if (option.starts_with("password=")) continue;
    url += separator + option;
    separator = '&';
  }
  return url;
}

}  // namespace scantrove
