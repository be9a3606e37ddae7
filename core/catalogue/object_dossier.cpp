#include "core/catalogue/object_dossier.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/base/log.h"
#include "core/catalogue/object_database.h"

namespace scantrove {
namespace {

constexpr int kMostReadings = 3;  ///< a writer that starts during a reading makes it inconsistent

Result<std::vector<AlikeObject>> readAlike(ObjectDatabase& database, const CatalogueModel& catalogue,
                                           ObjectId object) {
  const Result<std::set<ObjectPair>> different = database.differences().pairs();
  if (!different) return fail(different.error());
  std::vector<StoredDescriptor> views;
  const Result<std::int64_t> last = database.views().forEachDescriptor(
      0, [&views](const StoredDescriptor& view) { views.push_back(view); });
  if (!last) return fail(last.error());
  return findAlikeObjects(object, views, catalogue, *different);
}

Result<ObjectDossier> readFrom(ObjectDatabase& database, ObjectId object) {
  ObjectDossier dossier;
  dossier.object = object;
  const Result<CatalogueModel> catalogue = database.model();
  if (!catalogue) return fail(catalogue.error());
  if (const auto shown = catalogue->shown(object); !shown) return fail(shown.error());
  for (const auto& [id, state] : catalogue->objects()) {
    if (catalogue->mergeRoot(id) == object) dossier.ids.insert(id);
  }
  SCANTROVE_TRY(moveInto(dossier.catalogue, database.identity()));
  SCANTROVE_TRY(moveInto(dossier.views, database.views().of(object)));
  std::ranges::reverse(dossier.views);
  const auto cameras = database.sessions().cameras();
  if (!cameras) return fail(cameras.error());
  dossier.cloud = cloudOfViews(dossier.views, *cameras);
  Result<std::vector<AlikeObject>> alike = readAlike(database, *catalogue, object);
  // Views of an older version are described by the next scan, which may write.
  if (alike) {
    dossier.alike = std::move(*alike);
  } else {
    spdlog::warn("No objects are suggested for merging: {}", alike.error().message());
  }
  return dossier;
}

}  // namespace

Result<ObjectDossier> readDossier(const std::string& database, ObjectId object) {
  for (int i = 1;; ++i) {
    const Result<std::unique_ptr<ObjectDatabase>> opened = ObjectDatabase::openToRead(database);
    if (!opened) return fail(opened.error());
    Result<ObjectDossier> dossier = readFrom(**opened, object);
    if ((*opened)->isStill() || i == kMostReadings) return dossier;
  }
}

}  // namespace scantrove
