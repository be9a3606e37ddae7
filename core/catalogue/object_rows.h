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

/// The rows of the table `objects` that one operation concerns: read into a model, and written back as far as
/// the operation changed them. Inside the caller's transaction.
class ObjectRows {
 public:
  explicit ObjectRows(DatabaseConnection& connection);

  [[nodiscard]] CatalogueModel& model() { return model_; }

  [[nodiscard]] Result<void> readAll();
  /// The object and what it was merged into, to the end. Nothing if there is no such object.
  [[nodiscard]] Result<void> read(ObjectId id);
  [[nodiscard]] Result<void> read(std::span<const ObjectId> ids);
  /// The visible object of that name.
  [[nodiscard]] Result<void> readNamed(const std::string& name);
  /// The same for the names of these objects, and the "name (2)" that they would get instead.
  [[nodiscard]] Result<void> readNamesOf(std::span<const ObjectId> ids);
  /// What was merged into the object.
  [[nodiscard]] Result<void> readParts(ObjectId id);

  /// Writes what the model's operations changed: objects, who has their views, sizes and best views, events.
  [[nodiscard]] Result<void> store();

 private:
  [[nodiscard]] Result<void> select(const QString& condition, const QVariantList& values);
  /// Views that were stored for the object, or for what was merged into it, belong to `owner`.
  [[nodiscard]] Result<void> moveViews(ObjectId object, ObjectId owner);

  DatabaseConnection& connection_;
  CatalogueModel model_;
};

}  // namespace scantrove
