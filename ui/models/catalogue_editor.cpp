#include "ui/models/catalogue_editor.h"

#include <QDir>
#include <QFileInfo>
#include <QUndoCommand>
#include <opencv2/core.hpp>
#include <utility>

#include "core/database/server_address.h"

namespace scantrove {
namespace {

/// Copies a CV_8UC3 BGR picture.
QImage toImage(const cv::Mat& bgr) {
  if (bgr.empty() || bgr.type() != CV_8UC3) return {};
  return QImage(bgr.data, bgr.cols, bgr.rows, static_cast<qsizetype>(bgr.step[0]), QImage::Format_BGR888)
      .copy();
}

}  // namespace

/// A change that is done already when it is added to the history.
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

CatalogueEditor::CatalogueEditor(UndoHistory& history, QObject* parent)
    : QObject(parent), history_(history) {}
CatalogueEditor::~CatalogueEditor() { history_.forget(this); }

Result<void> CatalogueEditor::open(const QString& file) {
  const QString folder = QFileInfo(file).absolutePath();
  if (!isServerAddress(file.toStdString()) && !QDir().mkpath(folder)) {
    return fail("Cannot create the folder " + folder.toStdString() + " for the catalogue.",
                "Choose another file with File > Open catalogue.");
  }
  Result<std::unique_ptr<ObjectDatabase>> opened_database = ObjectDatabase::open(file.toStdString());
  if (!opened_database) return fail(opened_database.error());
  // Read before the objects: changes in between are then reported twice, which is harmless.
  const Result<std::int64_t> last_event = (*opened_database)->lastEvent();
  if (!last_event) return fail(last_event.error());
  history_.forget(this);
  database_ = std::move(*opened_database);
  file_ = file;
  last_event_ = *last_event;
  emit opened();
  return {};
}

void CatalogueEditor::close() {
  history_.forget(this);
  database_.reset();
  file_.clear();
  last_event_ = 0;
  emit opened();
}

template <class T>
T CatalogueEditor::valueOr(Result<T> result, T fallback) {
  if (result) return std::move(*result);
  announce(result.error());
  return fallback;
}

std::vector<ObjectRecord> CatalogueEditor::objects() {
  return isOpen() ? valueOr(database_->objects(), {}) : std::vector<ObjectRecord>();
}

CatalogueModel CatalogueEditor::catalogue() {
  return isOpen() ? valueOr(database_->model(), CatalogueModel()) : CatalogueModel();
}

Result<std::optional<ObjectRecord>> CatalogueEditor::mergeRootOf(ObjectId object) {
  std::optional<ObjectRecord> record;
  if (!isOpen()) return record;
  const Result<ObjectId> root = database_->mergeRoot(object);
  if (!root) return fail(root.error());
  if (*root) SCANTROVE_TRY(moveInto(record, database_->object(*root)));
  return record;
}

Result<std::optional<ObjectRecord>> CatalogueEditor::object(ObjectId object) {
  Result<std::optional<ObjectRecord>> record = mergeRootOf(object);
  if (record && *record && (*record)->id != object) record->reset();
  return record;
}

QImage CatalogueEditor::picture(ObjectId object) {
  return isOpen() ? toImage(valueOr(database_->views().picture(object), {})) : QImage();
}

std::vector<QImage> CatalogueEditor::pictures(ObjectId object) {
  std::vector<QImage> images;
  if (!isOpen()) return images;
  for (const cv::Mat& picture : valueOr(database_->views().pictures(object), {}))
    images.push_back(toImage(picture));
  return images;
}

void CatalogueEditor::poll() {
  if (!isOpen()) return;
  const Result<CatalogueChanges> changes = database_->changesAfter(last_event_);
  if (!changes) {
    // A server that is away fails each time.
    if (!std::exchange(is_poll_failing_, true)) announce(changes.error());
    return;
  }
  is_poll_failing_ = false;
  last_event_ = changes->last_event;
  if (!changes->changes.empty()) emit changed(*changes);
}

bool CatalogueEditor::run(const Action& action) {
  if (!isOpen()) return false;
  const Result<void> result = action(*database_);
  if (!result) {
    announce(result.error());
    return false;
  }
  poll();
  emit edited();
  return true;
}

bool CatalogueEditor::perform(const QString& text, const Action& action, const Action& inverse) {
  if (!run(action)) return false;
  history_.push(this, std::make_shared<Command>(*this, text, action, inverse));
  return true;
}

bool CatalogueEditor::rename(ObjectId object, const QString& name) {
  const Result<std::optional<ObjectRecord>> before = mergeRootOf(object);
  if (!before) {
    announce(before.error());
    return false;
  }
  if (!*before) {
    emit failed(
        tr("The object was deleted meanwhile, so it cannot be named “%1”. Undo the deletion and press "
           "Return again, or press Escape to cancel.")
            .arg(name));
    return false;
  }
  const std::string newer = name.trimmed().toStdString();
  const std::string older = (*before)->name;
  const ObjectId root = (*before)->id;
  if (newer == older) return true;
  return perform(
      tr("Rename “%1” to “%2”").arg(QString::fromStdString(older), name.trimmed()),
      [root, newer](ObjectDatabase& database) { return database.rename(root, newer); },
      [root, older, by = (*before)->named_by](ObjectDatabase& database) {
        return database.rename(root, older, by);
      });
}

bool CatalogueEditor::setConfirmed(const std::vector<ObjectId>& objects, bool confirmed) {
  // Only these objects change, so that undo restores each of them.
  std::vector<ObjectId> others;
  for (const ObjectId id : objects) {
    const Result<std::optional<ObjectRecord>> record = object(id);
    if (!record) {
      announce(record.error());
      return false;
    }
    if (*record && (*record)->confirmed != confirmed) others.push_back(id);
  }
  if (others.empty()) return false;
  return perform(
      others.size() > 1 ? (confirmed ? tr("Confirm %n objects", nullptr, static_cast<int>(others.size()))
                                     : tr("Unconfirm %n objects", nullptr, static_cast<int>(others.size())))
                        : (confirmed ? tr("Confirm object") : tr("Unconfirm object")),
      [others, confirmed](ObjectDatabase& database) { return database.setConfirmed(others, confirmed); },
      [others, confirmed](ObjectDatabase& database) { return database.setConfirmed(others, !confirmed); });
}

bool CatalogueEditor::remove(const std::vector<ObjectId>& objects) {
  if (objects.empty()) return false;
  return perform(
      objects.size() == 1 ? tr("Delete object")
                          : tr("Delete %n objects", nullptr, static_cast<int>(objects.size())),
      [objects](ObjectDatabase& database) { return database.remove(objects); },
      [objects](ObjectDatabase& database) { return database.restore(objects); });
}

bool CatalogueEditor::merge(const std::vector<ObjectId>& objects) {
  if (objects.size() < 2) return false;
  const auto merged = std::make_shared<ObjectMerge>();
  return perform(
      tr("Merge %n objects", nullptr, static_cast<int>(objects.size())),
      [objects, merged](ObjectDatabase& database) { return moveInto(*merged, database.merge(objects)); },
      [merged](ObjectDatabase& database) { return database.unmerge(*merged); });
}

}  // namespace scantrove
