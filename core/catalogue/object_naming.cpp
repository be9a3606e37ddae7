// What a person calls an object, and taking that back.
#include <array>

#include "core/catalogue/object_database.h"
#include "core/catalogue/object_name.h"
#include "core/catalogue/object_rows.h"
#include "core/database/database_connection.h"
#include "core/database/transaction.h"

namespace scantrove {
namespace {

bool isSetByPerson(const ObjectRow& row) { return row.confirmed || row.named_by == NamedBy::person; }

/// Stores another name, if it is one.
Result<void> giveName(DatabaseConnection& connection, const ObjectRow& before, const ObjectRow& row) {
  if (row.name == before.name && row.named_by == before.named_by) return {};
  return changeRow(connection, event::kRename, before, row);
}

}  // namespace

Result<std::string> ObjectDatabase::checkedName(const std::string& name) {
  const Result<QString> checked = checkedObjectName(name);
  if (!checked) return fail(checked.error());
  return checked->toStdString();
}

Result<ObjectNaming> ObjectDatabase::nameByPerson(ObjectId id, const std::string& name) {
  const Result<QString> requested = checkedObjectName(name);
  if (!requested) return fail(requested.error());
  return inTransaction(*connection_, [&]() -> Result<ObjectNaming> {
    const Result<ObjectRow> own = mergeRootOf(*connection_, id);
    if (!own) return fail(own.error());
    if (own->hidden) return fail(readVisibleRow(*connection_, own->id).error());
    const Result<ObjectId> called_so = visibleObjectNamed(*connection_, *requested);
    if (!called_so) return fail(called_so.error());
    const bool is_other = *called_so && *called_so != own->id;
    if (is_other && isSetByPerson(*own)) return ObjectNaming{};
    const Result<ObjectRow> before = is_other ? readVisibleRow(*connection_, *called_so) : own;
    if (!before) return fail(before.error());

    ObjectNaming naming{before->id, requested->toStdString(), before->name.toStdString(), before->named_by,
                        before->confirmed};
    ObjectRow row = *before;
    row.name = *requested;
    row.named_by = NamedBy::person;  // so it is the one that holds both
    SCANTROVE_TRY(giveName(*connection_, *before, row));
    SCANTROVE_TRY(markConfirmed(*connection_, row, true));
    if (is_other) SCANTROVE_TRY(moveInto(naming.merge, mergeRows(std::array{before->id, own->id})));
    return naming;
  });
}

Result<bool> ObjectDatabase::takeNameBack(const ObjectNaming& naming) {
  return inTransaction(*connection_, [&]() -> Result<bool> {
    bool is_done = false;
    if (naming.merge) {
      const Result<ObjectRow> part = readRow(*connection_, naming.merge->from.front());
      if (!part) return fail(part.error());
      is_done = part->hidden && part->merged_into == naming.object;
      if (is_done) SCANTROVE_TRY(unmergeRows(*naming.merge));
    }
    const Result<ObjectRow> now = readRow(*connection_, naming.object);
    if (!now) return fail(now.error());
    const QString name = QString::fromStdString(naming.name);
    const QString earlier = QString::fromStdString(naming.earlier_name);
    if (now->hidden || now->name != name || now->named_by != NamedBy::person) return is_done;
    const Result<ObjectId> called_so = visibleObjectNamed(*connection_, earlier);
    if (!called_so) return fail(called_so.error());
    if (*called_so && *called_so != now->id) return is_done;
    ObjectRow row = *now;
    row.name = earlier;
    row.named_by = naming.earlier_named_by;
    SCANTROVE_TRY(giveName(*connection_, *now, row));
    if (!naming.earlier_confirmed) SCANTROVE_TRY(markConfirmed(*connection_, row, false));
    return true;
  });
}

}  // namespace scantrove
