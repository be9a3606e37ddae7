#include "core/catalogue/catalogue_probe.h"

#include "core/catalogue/catalogue_schema.h"
#include "core/database/database_connection.h"
#include "core/database/server_address.h"

namespace scantrove {

Result<CatalogueProbe> probeCatalogue(const std::string& address) {
  if (const Result<ServerAddress> known = serverAddressFrom(address); !known) return fail(known.error());
  const auto connection = DatabaseConnection::openToRead(address);
  if (!connection) return fail(connection.error());
  const Result<int> version =
      schema::versionToRead(**connection, schema::kCatalogue, schema::catalogueSteps(), 0);
  if (!version) return fail(version.error());
  if (*version == 0) return CatalogueProbe{true, 0};
  Result<QSqlQuery> count = (*connection)->execute("SELECT count(*) FROM objects WHERE hidden = 0");
  if (!count) return fail(count.error());
  return CatalogueProbe{false, count->next() ? count->value(0).toInt() : 0};
}

}  // namespace scantrove
