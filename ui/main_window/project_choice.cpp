#include "ui/main_window/project_choice.h"

#include <QFileInfo>
#include <QSettings>
#include <filesystem>
#include <system_error>

#include "core/database/server_address.h"
#include "core/session/session_list.h"
#include "core/session/session_setup.h"
#include "core/session/session_store.h"
#include "ui/main_window/scan_controller.h"
#include "ui/models/catalogue_editor.h"

namespace scantrove {
namespace {

const QString kLastKey = QStringLiteral("project/last"), kRecentKey = QStringLiteral("project/recent");
constexpr int kMostRecent = 8;

QString fromPath(const std::filesystem::path& path) { return QString::fromStdString(path.string()); }

bool isOnServer(const QString& catalogue) { return isServerAddress(catalogue.toStdString()); }

/// Only opening it shows whether a server has it.
bool mayExist(const QString& place) { return isOnServer(place) || QFileInfo::exists(place); }

bool isSameFile(const QString& a, const QString& b) {
  return a == b || (QFileInfo::exists(a) && QFileInfo(a) == QFileInfo(b));
}

}  // namespace

ProjectChoice::ProjectChoice(CatalogueEditor& editor, ScanController& controller, QObject* parent)
    : QObject(parent), editor_(editor), controller_(controller) {}

bool ProjectChoice::show(const QString& file) {
  if (editor_.isOpen() && isSameFile(editor_.file(), file)) return true;
  const Result<void> opened = editor_.open(file);
  if (!opened) emit failed(QString::fromStdString(opened.error().message()));
  return opened.has_value();
}

void ProjectChoice::use(const Project& project) {
  project_ = project;
  is_chosen_ = true;
  controller_.setProject(project);
  emit changed();
}

bool ProjectChoice::showAndUse(const Project& project) {
  std::error_code ignored;  // opening the catalogue reports it
  if (!isOnServer(fromPath(project.catalogue)))
    std::filesystem::create_directories(project.catalogue.parent_path(), ignored);
  if (!show(fromPath(project.catalogue))) return false;
  use(project);
  return true;
}

QStringList ProjectChoice::recent() {
  QStringList places = QSettings().value(kRecentKey).toStringList();
  places.removeIf([](const QString& place) { return !mayExist(place); });
  return places;
}

QStringList ProjectChoice::recentServers() {
  QStringList servers = recent();
  servers.removeIf([](const QString& place) { return !isOnServer(place); });
  return servers;
}

QString ProjectChoice::titleOf(const QString& place) {
  return isOnServer(place) ? place : QFileInfo(place).fileName();
}

QString ProjectChoice::place() const {
  const QString catalogue = fromPath(project_.catalogue);
  return isOnServer(catalogue) ? catalogue : fromPath(project_.catalogue.parent_path());
}

std::string ProjectChoice::catalogueFile() const {
  return isOnServer(fromPath(project_.catalogue)) ? defaultProject().catalogue.string()
                                                  : project_.catalogue.string();
}

void ProjectChoice::remember() const {
  // A catalogue outside projects has a project of its own, which no folder describes.
  const Result<Project> of_folder = openProject(project_.folder);
  const bool is_whole = of_folder && of_folder->catalogue == project_.catalogue;
  const QString place = fromPath(is_whole ? project_.folder : project_.catalogue);
  QStringList places = recent();
  places.removeAll(place);
  places.prepend(place);
  QSettings().setValue(kLastKey, place);
  QSettings().setValue(kRecentKey, QStringList(places.mid(0, kMostRecent)));
}

void ProjectChoice::openAtStart(const QString& project, const QString& catalogue) {
  if (!project.isEmpty()) {
    if (const Result<Project> given = openProject(project.toStdString()); !given) {
      emit failed(QString::fromStdString(given.error().message()));
    } else if (showAndUse(*given)) {
      return remember();
    }
  }
  if (!catalogue.isEmpty()) {
    showAndUse(projectOfCatalogue(catalogue.toStdString()));
    return;
  }
  const QString last = project.isEmpty() ? QSettings().value(kLastKey).toString() : QString();
  // The choice stays stored, because the disk may only be missing now.
  if (!last.isEmpty() && !mayExist(last)) {
    emit warned(tr("The last project %1 is missing. The window uses %2 now. Put it back and restart, or "
                   "choose another with File > Open project.")
                    .arg(last, fromPath(defaultProject().folder)));
  } else if (!last.isEmpty() && QFileInfo(last).isDir()) {
    const Result<Project> earlier = openProject(last.toStdString());
    if (earlier && showAndUse(*earlier)) return;
    if (!earlier) emit failed(QString::fromStdString(earlier.error().message()));
  } else if (!last.isEmpty() && showAndUse(projectOfCatalogue(last.toStdString()))) {
    return;
  }
  showAndUse(defaultProject());
}

bool ProjectChoice::open(const QString& folder) {
  const Result<Project> project = openProject(folder.toStdString());
  if (!project) {
    emit failed(QString::fromStdString(project.error().message()));
    return false;
  }
  if (!showAndUse(*project)) return false;
  remember();
  return true;
}

bool ProjectChoice::create(const QString& folder) {
  if (const Result<Project> project = createProject(folder.toStdString(), {}); !project) {
    emit failed(QString::fromStdString(project.error().message()));
    return false;
  }
  return open(folder);
}

void ProjectChoice::chooseCatalogue(const QString& file, bool is_scan_shown) {
  const Project project = projectOfCatalogue(file.toStdString());
  const QString path = fromPath(project.catalogue);
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
  use(project);
  remember();
}

void ProjectChoice::showChosen() {
  if (is_chosen_) show(fromPath(project_.catalogue));
}

void ProjectChoice::showCatalogueOf(const QString& session_folder) {
  const std::filesystem::path folder = session_folder.toStdString();
  const SessionMetadata metadata = readSessionMetadata(folder);
  if (metadata.empty() && SessionStore::isSession(folder)) return;  // opening it reports the damage
  SessionSetup setup;
  if (const auto database = metadata.find("database"); database != metadata.end())
    setup.database = database->second;
  const QString file = QString::fromStdString(databaseFileOf(setup, folder).string());
  if (file.isEmpty()) return editor_.close();
  if (!mayExist(file)) {
    editor_.close();
    emit warned(tr("The catalogue %1 of this scan is missing, so no objects are shown. Put the file back and "
                   "open the scan again.")
                    .arg(file));
    return;
  }
  if (!show(file)) editor_.close();
}

}  // namespace scantrove
