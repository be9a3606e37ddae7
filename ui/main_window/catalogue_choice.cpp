#include "ui/main_window/catalogue_choice.h"

#include <QFileInfo>
#include <QSettings>

#include "core/session/session_list.h"
#include "core/session/session_setup.h"
#include "ui/main_window/scan_controller.h"
#include "ui/models/catalogue_editor.h"

namespace scantrove {
namespace {

const QString kChosenKey = QStringLiteral("catalogue/file");

bool isSameFile(const QString& a, const QString& b) {
  return a == b || (QFileInfo::exists(a) && QFileInfo(a) == QFileInfo(b));
}

}  // namespace

CatalogueChoice::CatalogueChoice(CatalogueEditor& editor, ScanController& controller, QObject* parent)
    : QObject(parent), editor_(editor), controller_(controller) {}

bool CatalogueChoice::show(const QString& file) {
  if (editor_.isOpen() && isSameFile(editor_.file(), file)) return true;
  const Result<void> opened = editor_.open(file);
  if (!opened) emit failed(QString::fromStdString(opened.error().message()));
  return opened.has_value();
}

void CatalogueChoice::use(const QString& file) {
  chosen_ = file;
  controller_.setDatabase(file);
}

void CatalogueChoice::openAtStart(const QString& given) {
  if (!given.isEmpty()) {
    if (show(given)) use(given);
    return;
  }
  const QString last = QSettings().value(kChosenKey).toString();
  // The choice stays stored, because the disk with the file may only be missing now.
  if (!last.isEmpty() && !QFileInfo::exists(last)) {
    emit warned(tr("The last catalogue %1 is missing. The window uses %2 now. Put the file back and restart, "
                   "or choose another with File > Open catalogue.")
                    .arg(last, defaultCatalogueFile()));
  } else if (!last.isEmpty() && show(last)) {
    use(last);
    return;
  }
  if (show(defaultCatalogueFile())) use(defaultCatalogueFile());
}

void CatalogueChoice::choose(const QString& file, bool is_scan_shown) {
  const QString path = QFileInfo(file).absoluteFilePath();
  const bool is_shown = editor_.isOpen() && isSameFile(editor_.file(), path);
  if (is_scan_shown && !is_shown) {
    UndoHistory no_steps;
    CatalogueEditor trial(no_steps);  // creates it, or reports now why it cannot be used
    if (const Result<void> opened = trial.open(path); !opened) {
      emit failed(QString::fromStdString(opened.error().message()));
      return;
    }
    emit warned(tr("This scan keeps its own catalogue. The next scan uses %1.").arg(path));
  } else if (!show(path)) {
    return;
  }
  use(path);
  QSettings().setValue(kChosenKey, path);
}

void CatalogueChoice::showChosen() {
  if (!chosen_.isEmpty()) show(chosen_);
}

void CatalogueChoice::showCatalogueOf(const QString& session_folder) {
  const std::filesystem::path folder = session_folder.toStdString();
  SessionSetup setup;
  for (const SessionSummary& scan : listSessions(folder)) {
    if (scan.folder != folder) continue;
    if (!scan.damage.empty()) return;  // opening it reports the damage
    setup.database = scan.database;
  }
  const QString file = QString::fromStdString(databaseFileOf(setup, folder).string());
  if (file.isEmpty()) return editor_.close();
  if (!QFileInfo::exists(file)) {
    editor_.close();
    emit warned(tr("The catalogue %1 of this scan is missing, so no objects are shown. Put the file back and "
                   "open the scan again.")
                    .arg(file));
    return;
  }
  if (!show(file)) editor_.close();
}

}  // namespace scantrove
