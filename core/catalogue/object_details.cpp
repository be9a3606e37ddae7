#include "core/catalogue/object_details.h"

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

Result<ObjectDetails> readFrom(ObjectDatabase& database, ObjectId object) {
  ObjectDetails details;
  details.object = object;
  const Result<CatalogueModel> catalogue = database.model();
  if (!catalogue) return fail(catalogue.error());
  if (const auto shown = catalogue->shown(object); !shown) return fail(shown.error());
  for (const auto& [id, state] : catalogue->objects()) {
    if (catalogue->mergeRoot(id) == object) details.ids.insert(id);
  }
  SCANTROVE_TRY(moveInto(details.catalogue, database.identity()));
  SCANTROVE_TRY(moveInto(details.views, database.views().of(object)));
  std::ranges::reverse(details.views);
  const auto cameras = database.sessions().cameras();
  if (!cameras) return fail(cameras.error());
  details.cloud = cloudOfViews(details.views, *cameras);
  Result<std::vector<AlikeObject>> alike = readAlike(database, *catalogue, object);
  // Views of an older version are described by the next scan, which may write.
  if (alike) {
    details.alike = std::move(*alike);
  } else {
    spdlog::warn("No objects are suggested for merging: {}", alike.error().message());
  }
  return details;
}

}  // namespace

Result<ObjectDetails> readDetails(const std::string& database, ObjectId object) {
  for (int i = 1;; ++i) {
    const Result<std::unique_ptr<ObjectDatabase>> opened = ObjectDatabase::openToRead(database);
    if (!opened) return fail(opened.error());
    Result<ObjectDetails> details = readFrom(**opened, object);
    if ((*opened)->isStill() || i == kMostReadings) return details;
  }
}

}  // namespace scantrove
