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

/// Edits the catalogue for the user. Writes each change to the database at once, as one step that can be
/// undone. Owns the window's database connection and follows changes of other writers (the scan, other
/// programs). If the database rejects a change, emits failed() and adds no step.
class CatalogueEditor : public QObject {
  Q_OBJECT

 public:
  /// Adds steps to `history`, which outlives the editor.
  explicit CatalogueEditor(UndoHistory& history, QObject* parent = nullptr);
  ~CatalogueEditor() override;

  /// Opens another catalogue, a file or a server's address (creates it if missing) and clears its undo steps.
  /// On failure the old one stays open.
  [[nodiscard]] Result<void> open(const QString& file);
  /// Closes the catalogue: there are no objects, and nothing can be changed.
  void close();
  [[nodiscard]] bool isOpen() const { return database_ != nullptr; }
  [[nodiscard]] const QString& file() const { return file_; }

  [[nodiscard]] std::vector<ObjectRecord> objects();
  /// None if it was deleted or merged into another.
  [[nodiscard]] Result<std::optional<ObjectRecord>> object(ObjectId object);
  /// The states of all objects and classes; empty without a catalogue.
  [[nodiscard]] CatalogueModel catalogue();
  /// Thumbnail with dimmed surroundings; null if there is none.
  [[nodiscard]] QImage picture(ObjectId object);
  /// Thumbnails of all views of the object, newest first.
  [[nodiscard]] std::vector<QImage> pictures(ObjectId object);

  /// These return whether the change was done; otherwise failed() was emitted. If the object was merged
  /// meanwhile, renames the object that it was merged into.
  bool rename(ObjectId object, const QString& name);
  bool setConfirmed(const std::vector<ObjectId>& objects, bool confirmed);
  bool remove(const std::vector<ObjectId>& objects);
  /// The database chooses which object gets the views of the others.
  bool merge(const std::vector<ObjectId>& objects);

  using Action = std::function<Result<void>(ObjectDatabase&)>;
  /// Runs `action`; on success adds it with its inverse to the history.
  bool perform(const QString& text, const Action& action, const Action& inverse);

  /// Emits changed() if any writer changed the catalogue since the last call. Of several failures in a row
  /// announces the first one.
  void poll();
  void announce(const Error& error) { emit failed(QString::fromStdString(error.message())); }

 signals:
  void opened();
  void changed(const scantrove::CatalogueChanges& changes);
  void edited();  ///< by the user, including undo and redo; after changed()
  void failed(const QString& message);

 private:
  class Command;
  friend class Command;

  /// False if it failed; failed() was emitted.
  bool run(const Action& action);
  [[nodiscard]] Result<std::optional<ObjectRecord>> mergeRootOf(ObjectId object);
  template <class T>
  T valueOr(Result<T> result, T fallback);

  std::unique_ptr<ObjectDatabase> database_;
  QString file_;
  std::int64_t last_event_ = 0;
  bool is_poll_failing_ = false;
  UndoHistory& history_;
};

}  // namespace scantrove
