#pragma once
#include <QVariant>
#include <span>
#include <string>

#include "core/base/result.h"
#include "core/catalogue/catalogue_model.h"

namespace scantrove {

class DatabaseConnection;

/// For binding: null for 0.
[[nodiscard]] QVariant orNull(std::int64_t id);

/// The rows of the table `objects` for one operation: read into a model, and written back where the
/// operation changed them. Inside the caller's transaction.
class ObjectRows {
 public:
  explicit ObjectRows(DatabaseConnection& connection);

  [[nodiscard]] CatalogueModel& model() { return model_; }

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

  /// Writes the changes of the model: objects, owners of views, sizes and best views, events.
  [[nodiscard]] Result<void> store();

 private:
  [[nodiscard]] Result<void> select(const QString& condition, const QVariantList& values);
  /// Assigns views stored for the object, or for objects merged into it, to `owner`.
  [[nodiscard]] Result<void> moveViews(ObjectId object, ObjectId owner);

  DatabaseConnection& connection_;
  CatalogueModel model_;
};

}  // namespace scantrove
