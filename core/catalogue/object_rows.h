#pragma once
#include <QVariant>
#include <span>
#include <string>
#include <type_traits>

#include "core/base/result.h"
#include "core/catalogue/catalogue_model.h"
#include "core/database/transaction.h"

namespace scantrove {

class DatabaseConnection;

/// For binding: null for 0.
[[nodiscard]] QVariant orNull(std::int64_t id);

/// The rows of the table `objects` for one operation: read into a model, and written back where the
/// operation changed them. Inside the caller's transaction.
class ObjectRows {
 public:
  /// `has_classes`: whether the schema has them; older ones are only read.
  explicit ObjectRows(DatabaseConnection& connection, bool has_classes = true);

  [[nodiscard]] CatalogueModel& model() { return model_; }

  /// Reads all classes.
  [[nodiscard]] Result<void> readClasses();
  /// Reads all objects and classes.
  [[nodiscard]] Result<void> readAll();
  /// Reads the object and its chain of merges. Nothing if there is no such object.
  [[nodiscard]] Result<void> read(ObjectId id);
  [[nodiscard]] Result<void> read(std::span<const ObjectId> ids);
  /// Reads the visible object of that name.
  [[nodiscard]] Result<void> readNamed(const std::string& name);
  /// Reads objects with the names of these objects, and with the "name (2)" that would replace them.
  [[nodiscard]] Result<void> readNamesOf(std::span<const ObjectId> ids);
  /// Reads the objects that were merged into this one.
  [[nodiscard]] Result<void> readParts(ObjectId id);
  /// Reads the visible objects of that class and of those that are merged into it.
  [[nodiscard]] Result<void> readOfClass(ClassId root);

  /// Writes the changes of the model: objects, classes, owners of views, sizes and best views, events.
  [[nodiscard]] Result<void> store();

 private:
  [[nodiscard]] Result<void> select(const QString& condition, const QVariantList& values);
  /// Assigns views stored for the object, or for objects merged into it, to `owner`.
  [[nodiscard]] Result<void> moveViews(ObjectId object, ObjectId owner);

  [[nodiscard]] Result<void> storeObject(const CatalogueChange& change);
  [[nodiscard]] Result<void> storeClass(const ObjectClass& row);

  DatabaseConnection& connection_;
  const bool has_classes_;
  CatalogueModel model_;
};

/// One operation on objects or classes: reads its rows, lets the model decide, and stores the changes, as one
/// transaction.
template <class Read, class Decide>
auto changeCatalogue(DatabaseConnection& connection, Read&& read, Decide&& decide)
    -> std::invoke_result_t<Decide, CatalogueModel&> {
  using Answer = std::invoke_result_t<Decide, CatalogueModel&>;
  return inTransaction(connection, [&]() -> Answer {
    ObjectRows rows(connection);
    SCANTROVE_TRY(rows.readClasses());
    SCANTROVE_TRY(read(rows));
    Answer answer = decide(rows.model());
    if (answer) SCANTROVE_TRY(rows.store());
    return answer;
  });
}

}  // namespace scantrove
