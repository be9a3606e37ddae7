#include "ui/models/catalogue_editor.h"

#include <QDir>
#include <QFileInfo>
#include <QStandardPaths>
#include <QUndoCommand>

namespace scantrove {

/// A change that was already made when it is put on the stack.
class CatalogueEditor::Command final : public QUndoCommand {
 public:
  Command(CatalogueEditor& editor, const QString& text, Action action, Action inverse)
      : QUndoCommand(text), editor_(editor), action_(std::move(action)), inverse_(std::move(inverse)) {}

  void redo() override {
    if (done_) return;
    done_ = editor_.run(action_);
    if (!done_) setObsolete(true);
  }

  void undo() override {
    if (!editor_.run(inverse_)) setObsolete(true);
    done_ = false;
  }

 private:
  CatalogueEditor& editor_;
  Action action_;
  Action inverse_;
  bool done_ = true;
};

CatalogueEditor::CatalogueEditor(QObject* parent) : QObject(parent) {}
CatalogueEditor::~CatalogueEditor() { undo_.clear(); }

Result<void> CatalogueEditor::open(const QString& file) {
  const QString folder = QFileInfo(file).absolutePath();
  if (!QDir().mkpath(folder)) {
    return fail("Cannot create the folder " + folder.toStdString() + " for the catalogue.",
                "Choose another place with File > Open catalogue.");
  }
  Result<std::unique_ptr<ObjectDatabase>> opened_database = ObjectDatabase::open(file.toStdString());
  if (!opened_database) return fail(opened_database.error());
  undo_.clear();
  database_ = std::move(*opened_database);
  file_ = file;
  emit opened();
  emit changed();
  return {};
}

template <class T>
T CatalogueEditor::valueOr(Result<T> result, T fallback) {
  if (result) return std::move(*result);
  emit failed(QString::fromStdString(result.error().message()));
  return fallback;
}

std::vector<ObjectRecord> CatalogueEditor::objects() {
  return isOpen() ? valueOr(database_->objects(), {}) : std::vector<ObjectRecord>();
}

std::vector<ObjectView> CatalogueEditor::views(ObjectId object) {
  return isOpen() ? valueOr(database_->views(object), {}) : std::vector<ObjectView>();
}

cv::Mat CatalogueEditor::picture(ObjectId object) {
  return isOpen() ? valueOr(database_->picture(object), {}) : cv::Mat();
}

bool CatalogueEditor::run(const Action& action) {
  if (!isOpen()) return false;
  const Result<void> result = action(*database_);
  // Also after a failure: of several objects some may have changed.
  emit changed();
  if (!result) emit failed(QString::fromStdString(result.error().message()));
  return result.has_value();
}

bool CatalogueEditor::perform(const QString& text, const Action& action, const Action& inverse) {
  if (!run(action)) return false;
  undo_.push(new Command(*this, text, action, inverse));
  return true;
}

bool CatalogueEditor::rename(ObjectId object, const QString& name) {
  if (!isOpen()) return false;
  const Result<ObjectRecord> before = database_->object(object);
  if (!before) {
    emit failed(QString::fromStdString(before.error().message()));
    return false;
  }
  const std::string newer = name.trimmed().toStdString();
  const std::string older = before->name;
  if (newer == older) return true;
  return perform(
      tr("Rename “%1” to “%2”").arg(QString::fromStdString(older), name.trimmed()),
      [object, newer](ObjectDatabase& database) { return database.rename(object, newer); },
      [object, older, by = before->named_by](ObjectDatabase& database) {
        return database.rename(object, older, by);
      });
}

bool CatalogueEditor::setConfirmed(ObjectId object, bool confirmed) {
  return perform(
      confirmed ? tr("Confirm object") : tr("Unconfirm object"),
      [object, confirmed](ObjectDatabase& database) {
        return database.setConfirmed({&object, 1}, confirmed);
      },
      [object, confirmed](ObjectDatabase& database) {
        return database.setConfirmed({&object, 1}, !confirmed);
      });
}

bool CatalogueEditor::remove(const std::vector<ObjectId>& objects) {
  if (objects.empty()) return false;
  return perform(
      objects.size() == 1 ? tr("Delete object") : tr("Delete %1 objects").arg(objects.size()),
      [objects](ObjectDatabase& database) { return database.remove(objects); },
      [objects](ObjectDatabase& database) { return database.restore(objects); });
}

bool CatalogueEditor::merge(const std::vector<ObjectId>& objects) {
  if (objects.size() < 2) return false;
  const auto merge = std::make_shared<ObjectMerge>();
  return perform(
      tr("Merge %1 objects").arg(objects.size()),
      [objects, merge](ObjectDatabase& database) { return moveInto(*merge, database.merge(objects)); },
      [merge](ObjectDatabase& database) { return database.unmerge(*merge); });
}

QString defaultCatalogueFile() {
  const QString data = QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation);
  return data + QStringLiteral("/scantrove/catalogue.sqlite");
}

}  // namespace scantrove
