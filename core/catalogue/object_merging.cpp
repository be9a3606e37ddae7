// The operations of ObjectDatabase that hide objects and bring them back. Nothing is ever deleted.
#include <QJsonArray>
#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "core/catalogue/object_database.h"
#include "core/catalogue/object_rows.h"
#include "core/catalogue/view_rows.h"
#include "core/database/database_connection.h"
#include "core/database/transaction.h"

namespace scantrove {
namespace {

/// Views that were first seen as `id` or as an object merged into it, directly or not. CROSS JOIN: by index,
/// not by a walk through all images.
constexpr const char* kOwnViews =
    "WITH RECURSIVE family (id) AS (SELECT id FROM objects WHERE id = ?"
    " UNION SELECT o.id FROM objects o JOIN family f ON o.merged_into = f.id)"
    " SELECT v.id FROM family f CROSS JOIN views v ON v.first_object = f.id ORDER BY v.id";

/// Changes who holds the views of `row`'s object and stores the row; both objects' sizes follow.
Result<void> giveViews(DatabaseConnection& connection, const char* action, const ObjectRow& before,
                       const ObjectRow& row, ObjectId to) {
  Result<QSqlQuery> query = connection.execute(kOwnViews, {row.id.value});
  if (!query) return fail(query.error());
  QVariantList ids;
  while (query->next()) ids.push_back(query->value(0));
  for (const QVariant& id : ids) {
    SCANTROVE_TRY(connection.execute("UPDATE views SET object = ? WHERE id = ?", {to.value, id}));
  }
  return changeRow(connection, action, before, row);
}

/// Gives a hidden row the state of a visible one; when its name was given away meanwhile it becomes
/// "name (2)", "name (3)", ...
Result<ObjectRow> shown(DatabaseConnection& connection, const ObjectRow& hidden) {
  ObjectRow row = hidden;
  for (int copy = 2;; ++copy) {
    const Result<ObjectId> other = visibleObjectNamed(connection, row.name);
    if (!other) return fail(other.error());
    if (!*other) break;
    row.name = QString("%1 (%2)").arg(hidden.name).arg(copy);
  }
  row.hidden = false;
  row.merged_into = {};
  return row;
}

/// The objects to merge, the one that shall hold the others' views first: what a person did counts most.
Result<std::vector<ObjectRow>> contenders(DatabaseConnection& connection, std::span<const ObjectId> objects) {
  const std::set<ObjectId> distinct(objects.begin(), objects.end());
  if (distinct.size() < 2) {
    return fail("An object cannot be merged with itself.", "Choose two objects or more.");
  }
  std::vector<ObjectRow> rows;  // the oldest first
  for (const ObjectId id : distinct) {
    const Result<ObjectRow> row = readVisibleRow(connection, id);
    if (!row) return fail(row.error());
    rows.push_back(*row);
  }
  std::ranges::stable_sort(rows, std::greater<>(), [](const ObjectRow& row) {
    return std::pair(row.named_by == NamedBy::person, row.confirmed);
  });
  return rows;
}

}  // namespace

Result<ObjectId> ObjectDatabase::resolve(ObjectId id) {
  const Result<ObjectRow> row = mergeRootOf(*connection_, id);
  if (!row) return fail(row.error());
  return row->hidden ? ObjectId{} : row->id;
}

Result<std::vector<MergeRoot>> ObjectDatabase::mergeRoots() {
  Result<QSqlQuery> query = connection_->execute("SELECT id, hidden, merged_into FROM objects ORDER BY id");
  if (!query) return fail(query.error());
  std::map<ObjectId, ObjectId> next;  // itself for visible objects, none for deleted ones
  while (query->next()) {
    const ObjectId id{query->value(0).toUInt()};
    next[id] = query->value(1).toInt() == 0 ? id : ObjectId{query->value(2).toUInt()};
  }
  std::vector<MergeRoot> result;
  for (const auto& [id, first] : next) {
    ObjectId before = id, root = first;
    std::set<ObjectId> passed;
    while (root && root != before && passed.insert(root).second) {
      const auto found = next.find(root);
      before = root;
      root = found == next.end() ? ObjectId{} : found->second;
    }
    result.push_back({id, root == before ? root : ObjectId{}});
  }
  return result;
}

Result<ObjectMerge> ObjectDatabase::merge(std::span<const ObjectId> objects, const Check& check) {
  return inTransaction(*connection_, [&]() -> Result<ObjectMerge> {
    SCANTROVE_TRY(check());
    return mergeRows(objects);
  });
}

Result<ObjectMerge> ObjectDatabase::mergeRows(std::span<const ObjectId> objects) {
  const Result<std::vector<ObjectRow>> ranked = contenders(*connection_, objects);
  if (!ranked) return fail(ranked.error());
  const ObjectRow& root = ranked->front();
  ObjectMerge merge{root.id, {}, false};
  for (const ObjectRow& other : std::span(*ranked).subspan(1)) {
    ObjectRow row = other;
    row.hidden = true;
    row.merged_into = root.id;
    SCANTROVE_TRY(giveViews(*connection_, event::kMerge, other, row, root.id));
    SCANTROVE_TRY(refreshObject(*connection_, row.id));
    merge.from.push_back(row.id);
    merge.has_confirmed = merge.has_confirmed || (row.confirmed && !root.confirmed);
  }
  if (merge.has_confirmed) SCANTROVE_TRY(markConfirmed(*connection_, root, true));
  SCANTROVE_TRY(refreshObject(*connection_, root.id));
  return merge;
}

Result<void> ObjectDatabase::unmerge(const ObjectMerge& merge) {
  return inTransaction(*connection_, [&] { return unmergeRows(merge); });
}

Result<void> ObjectDatabase::unmergeRows(const ObjectMerge& merge) {
  for (const ObjectId id : merge.from) {
    const Result<ObjectRow> before = readRow(*connection_, id);
    if (!before) return fail(before.error());
    if (!before->hidden || before->merged_into != merge.into) {
      return fail("The object " + std::to_string(id.value) + " (" + before->name.toStdString() + ") in " +
                      connection_->file() + " is not merged into object " + std::to_string(merge.into.value) +
                      ".",
                  "There is nothing to undo.");
    }
    const Result<ObjectRow> row = shown(*connection_, *before);
    if (!row) return fail(row.error());
    SCANTROVE_TRY(giveViews(*connection_, event::kUnmerge, *before, *row, id));
    SCANTROVE_TRY(refreshObject(*connection_, id));
  }
  const Result<ObjectRow> into = readRow(*connection_, merge.into);
  if (!into) return fail(into.error());
  if (merge.has_confirmed) SCANTROVE_TRY(markConfirmed(*connection_, *into, false));
  SCANTROVE_TRY(refreshObject(*connection_, merge.into));
  // It may be part of another by now, which held these views, too.
  const Result<ObjectRow> root = mergeRootOf(*connection_, merge.into);
  if (!root) return fail(root.error());
  if (root->id == merge.into) return {};
  SCANTROVE_TRY(refreshObject(*connection_, root->id));
  return recordEvent(*connection_, event::kDiscardViews, root->id, {},
                     {{"unmerged", static_cast<qint64>(merge.from.front().value)}});
}

Result<void> ObjectDatabase::remove(std::span<const ObjectId> objects) {
  return inTransaction(*connection_, [&]() -> Result<void> {
    for (const ObjectId id : std::set<ObjectId>(objects.begin(), objects.end())) {
      const Result<ObjectRow> before = readVisibleRow(*connection_, id);
      if (!before) return fail(before.error());
      ObjectRow row = *before;
      row.hidden = true;
      SCANTROVE_TRY(changeRow(*connection_, event::kRemove, *before, row));
    }
    return {};
  });
}

Result<bool> ObjectDatabase::withdraw(ObjectId made) {
  return inTransaction(*connection_, [&]() -> Result<bool> {
    const Result<ObjectRow> before = readRow(*connection_, made);
    if (!before) return fail(before.error());
    if (before->hidden || before->confirmed || before->named_by == NamedBy::person) return false;
    Result<QSqlQuery> parts =
        connection_->execute("SELECT id FROM objects WHERE merged_into = ?", {made.value});
    if (!parts) return fail(parts.error());
    if (parts->next()) return false;
    ObjectRow row = *before;
    row.hidden = true;
    SCANTROVE_TRY(changeRow(*connection_, event::kRemove, *before, row));
    return true;
  });
}

Result<void> ObjectDatabase::restore(std::span<const ObjectId> objects) {
  return inTransaction(*connection_, [&]() -> Result<void> {
    for (const ObjectId id : objects) {
      const Result<ObjectRow> before = readRow(*connection_, id);
      if (!before) return fail(before.error());
      if (!before->hidden) continue;
      if (before->merged_into) return fail(readVisibleRow(*connection_, id).error());
      const Result<ObjectRow> row = shown(*connection_, *before);
      if (!row) return fail(row.error());
      SCANTROVE_TRY(changeRow(*connection_, event::kRestore, *before, *row));
    }
    return {};
  });
}

}  // namespace scantrove
