#include "core/session/session_catalogue.h"

#include <memory>
#include <utility>

#include "core/base/first_error.h"
#include "core/catalogue/object_database.h"
#include "core/compute/guarded.h"
#include "core/session/catalogue_edit.h"
#include "core/session/session_joining.h"

namespace scantrove {
namespace {

Result<std::unique_ptr<ObjectDatabase>> openCatalogueOf(OpenSession& session) {
  const std::filesystem::path file = catalogueFileOf(session);
  if (file.empty()) return fail("The session " + session.folder().string() + " has no catalogue.");
  if (!mayCatalogueExist(file)) {
    return fail("The catalogue " + file.string() + " of this session is not there.",
                "Put it back; it follows when the session is opened next.");
  }
  Result<std::unique_ptr<ObjectDatabase>> database = ObjectDatabase::open(file.string());
  if (!database) return database;
  // Another file may have this name by now, to which the session's ids do not belong.
  const Result<bool> is_other = session.useCatalogue(**database);
  if (!is_other) return fail(is_other.error());
  return database;
}

}  // namespace

std::filesystem::path catalogueFileOf(const OpenSession& session) {
  return databaseFileOf(session.setup(), session.folder());
}

bool isCataloguePending(const OpenSession& session) {
  return !session.pendingEdits().empty() || areJoinsPending(session);
}

Result<void> applyToCatalogue(OpenSession& session) {
  return guarded("telling the catalogue", [&]() -> Result<void> {
    if (!isCataloguePending(session)) return {};
    const auto database = openCatalogueOf(session);
    if (!database) return fail(database.error());
    FirstError first;
    first.note(mergeJoinedObjects(session, **database));
    for (const PendingEdit& edit : session.pendingEdits()) {
      const Result<CatalogueOutcome> outcome = CatalogueEdit(session, **database).carryOut(edit);
      if (!outcome) return fail(outcome.error());
      SCANTROVE_TRY(session.completeEdit(outcome->metadata, outcome->objects));
      for (const Error& refusal : outcome->refusals) first.note(fail(refusal));
    }
    return first.result();
  });
}

}  // namespace scantrove
