#pragma once
#include <QObject>
#include <QString>
#include <QUndoStack>
#include <functional>
#include <memory>
#include <vector>

#include "core/catalog/object_database.h"

namespace scantrove {

/// The person's hand on the catalogue: every change is written to the database at once and can be undone.
/// Owns the window's own database connection. A change that the database refuses is announced and not put on
/// the undo stack.
class CatalogueEditor : public QObject {
  Q_OBJECT

 public:
  explicit CatalogueEditor(QObject* parent = nullptr);
  ~CatalogueEditor() override;

  /// Opens another catalogue (creating it when missing) and forgets what could be undone. On failure the old
  /// one stays open.
  [[nodiscard]] Result<void> open(const QString& file);
  [[nodiscard]] bool isOpen() const { return database_ != nullptr; }
  [[nodiscard]] const QString& file() const { return file_; }

  [[nodiscard]] std::vector<ObjectRecord> objects();
  [[nodiscard]] std::vector<ObjectView> views(ObjectId object);
  [[nodiscard]] cv::Mat picture(ObjectId object);

  /// Each returns whether it was done; when not, failed() has said why.
  bool rename(ObjectId object, const QString& name);
  bool setConfirmed(ObjectId object, bool confirmed);
  bool remove(const std::vector<ObjectId>& objects);
  bool merge(const std::vector<ObjectId>& objects);

  [[nodiscard]] QUndoStack& undoStack() { return undo_; }

 signals:
  void opened();
  void changed();  ///< the database differs from before; also after undo and redo
  void failed(const QString& message);

 private:
  using Action = std::function<Result<void>(ObjectDatabase&)>;
  class Command;
  friend class Command;

  /// Runs `action`; only when that worked the pair goes on the undo stack.
  bool perform(const QString& text, const Action& action, const Action& inverse);
  /// False when it failed, which was announced.
  bool run(const Action& action);
  template <class T>
  T valueOr(Result<T> result, T fallback);

  std::unique_ptr<ObjectDatabase> database_;
  QString file_;
  QUndoStack undo_;
};

/// $XDG_DATA_HOME/scantrove/catalogue.sqlite.
[[nodiscard]] QString defaultCatalogueFile();

}  // namespace scantrove
