#pragma once
#include <QImage>
#include <QObject>
#include <QString>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/catalogue/object_database.h"
#include "ui/models/undo_history.h"

namespace scantrove {

/// The person's hand on the catalogue: every change is written to the database at once, as one step that can
/// be undone. Owns the window's own database connection, and follows what others (the scan, other programs)
/// write. A change that the database refuses is announced and no step.
class CatalogueEditor : public QObject {
  Q_OBJECT

 public:
  /// Steps go into `history`, which outlives the editor.
  explicit CatalogueEditor(UndoHistory& history, QObject* parent = nullptr);
  ~CatalogueEditor() override;

  /// Opens another catalogue (creating it when missing) and forgets what could be undone. On failure the old
  /// one stays open.
  [[nodiscard]] Result<void> open(const QString& file);
  /// Shows no catalogue: there are no objects, and nothing can be changed.
  void close();
  [[nodiscard]] bool isOpen() const { return database_ != nullptr; }
  [[nodiscard]] const QString& file() const { return file_; }

  [[nodiscard]] std::vector<ObjectRecord> objects();
  /// None when it was deleted or merged into another.
  [[nodiscard]] Result<std::optional<ObjectRecord>> object(ObjectId object);
  /// Small, the object's surroundings dimmed; null when there is none.
  [[nodiscard]] QImage picture(ObjectId object);
  /// Of all the object's views, newest first.
  [[nodiscard]] std::vector<QImage> pictures(ObjectId object);

  /// Each returns whether it was done; when not, failed() has said why.
  /// An object that was merged meanwhile is renamed in the one that holds it now.
  bool rename(ObjectId object, const QString& name);
  bool setConfirmed(const std::vector<ObjectId>& objects, bool confirmed);
  bool remove(const std::vector<ObjectId>& objects);
  /// The database chooses which one holds the others' views from then on.
  bool merge(const std::vector<ObjectId>& objects);

  /// Announces what was written since the last time, by whomever.
  void poll();
  void announce(const Error& error) { emit failed(QString::fromStdString(error.message())); }

 signals:
  void opened();
  void changed(const scantrove::CatalogueChanges& changes);
  void edited();  ///< by the person, undo and redo included; after changed()
  void failed(const QString& message);

 private:
  using Action = std::function<Result<void>(ObjectDatabase&)>;
  class Command;
  friend class Command;

  /// Runs `action`; only when that worked the pair goes into the history.
  bool perform(const QString& text, const Action& action, const Action& inverse);
  /// False when it failed, which was announced.
  bool run(const Action& action);
  [[nodiscard]] Result<std::optional<ObjectRecord>> mergeRootOf(ObjectId object);
  template <class T>
  T valueOr(Result<T> result, T fallback);

  std::unique_ptr<ObjectDatabase> database_;
  QString file_;
  std::int64_t last_event_ = 0;
  UndoHistory& history_;
};

/// $XDG_DATA_HOME/scantrove/catalogue.sqlite.
[[nodiscard]] QString defaultCatalogueFile();

}  // namespace scantrove
