#include "ui/main_window/window_dialogs.h"

#include <QApplication>
#include <QFileInfo>
#include <QMessageBox>
#include <QPointer>
#include <QStandardPaths>

#include "core/project/project.h"
#include "ui/main_window/background_reading.h"
#include "ui/main_window/main_window.h"
#include "ui/main_window/project_choice.h"
#include "ui/main_window/saved_scan_list.h"
#include "ui/main_window/scan_controller.h"
#include "ui/panels/camera_dialog.h"
#include "ui/panels/class_dialog.h"
#include "ui/panels/export_dialog.h"
#include "ui/panels/file_dialogs.h"
#include "ui/panels/help_dialog.h"
#include "ui/panels/message_bar.h"
#include "ui/panels/server_dialog.h"
#include "ui/panels/source_dialog.h"

namespace scantrove {

WindowDialogs::WindowDialogs(MainWindow& window) : QObject(&window), window_(window) {}

void WindowDialogs::openFolder() {
  const QString folder = chooseFolder(&window_, tr("Folder of a recording"));
  if (!folder.isEmpty()) window_.open(folder);
}

void WindowDialogs::openRecording() {
  const QString file = chooseFile(&window_, tr("Recording"),
                                  tr("Recordings, scans, projects (*.oni *.bag *.db3 *.mcap *.mkv *.r3d "
                                     "*.sens session.sqlite scantrove-project.json)"));
  if (!file.isEmpty()) window_.open(file);
}

void WindowDialogs::openWithOptions() {
  SourceDialog dialog(window_.controller().source(), &window_);
  if (dialog.exec() != QDialog::Accepted) return;
  window_.parts().messages->dismiss();
  window_.controller().open(dialog.source(), dialog.options(), dialog.poses(), dialog.object());
}

void WindowDialogs::openCamera() {
  CameraDialog dialog(listCameras, &window_);
  if (dialog.exec() != QDialog::Accepted || dialog.source().isEmpty()) return;
  if (!dialog.object()) return window_.open(dialog.source());
  window_.parts().messages->dismiss();
  window_.controller().open(dialog.source(), {}, ScanRequest::Poses::automatic, dialog.object());
}

void WindowDialogs::chooseCatalogue() {
  const QString file = chooseFileToSave(&window_, tr("Catalogue to open or create"),
                                        QString::fromStdString(window_.project().catalogueFile()),
                                        tr("Catalogues (*.sqlite)"));
  if (!file.isEmpty()) window_.openCatalogue(file);
}

void WindowDialogs::connectCatalogue() {
  ServerDialog dialog(ProjectChoice::recentServers(), &window_);
  if (dialog.exec() == QDialog::Accepted) window_.openCatalogue(dialog.address());
}

void WindowDialogs::openProject() {
  const QString folder = chooseFolder(&window_, tr("Folder of a project"), projectsFolder());
  if (!folder.isEmpty()) window_.openProjectFolder(folder);
}

void WindowDialogs::newProject() {
  const QString folder = chooseFileToSave(&window_, tr("New folder for the project"),
                                          projectsFolder() + QLatin1Char('/') + tr("My objects"), {});
  if (!folder.isEmpty()) window_.createProjectFolder(folder);
}

QString WindowDialogs::projectsFolder() const {
  const Project& project = window_.project().project();
  const bool is_default = project.folder == defaultProject().folder;
  return is_default ? QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation)
                    : QString::fromStdString(project.folder.parent_path().string());
}

void WindowDialogs::chooseSession() {
  const QString folder = chooseFolder(&window_, tr("Saved scan"), window_.controller().scansFolder());
  if (!folder.isEmpty()) window_.openSession(folder);
}

void WindowDialogs::showExport() {
  if (export_ != nullptr && export_->isWorking()) {
    export_->raise();
    return;
  }
  delete export_;
  export_ = new ExportDialog(QFileInfo(window_.controller().sessionFolder()).fileName(), &window_);
  offerProject();
  ScanBridge& bridge = window_.controller().bridge();
  connect(export_, &ExportDialog::posted, &bridge, &ScanBridge::post);
  connect(&bridge, &ScanBridge::eventArrived, export_, &ExportDialog::handleEvent);
  export_->show();
  export_->raise();
  export_->activateWindow();
}

void WindowDialogs::showClasses() {
  if (classes_ == nullptr) classes_ = new ClassDialog(window_.editor(), &window_);
  classes_->show();
  classes_->raise();
  classes_->activateWindow();
}

void WindowDialogs::offerProject() {
  const auto project = projectOfScan(window_.controller().sessionFolder().toStdString());
  if (!project) return;
  readInBackground(
      this,
      [folder = QString::fromStdString(project->scansFolder().string())] { return savedScanNamesIn(folder); },
      [dialog = QPointer<ExportDialog>(export_),
       name = QString::fromStdString(project->name)](const QStringList& scans) {
        if (dialog != nullptr) dialog->setProject(name, scans);
      });
}

void WindowDialogs::showHelp() {
  if (help_ == nullptr) help_ = new HelpDialog(&window_);
  help_->show();
  help_->raise();
  help_->activateWindow();
}

void WindowDialogs::showAbout() {
  QMessageBox::about(
      &window_, tr("About Scantrove"),
      tr("<h3>Scantrove %1</h3><p>Scan a scene with an RGB-D camera and collect its objects in a "
         "catalogue.</p>")
          .arg(QApplication::applicationVersion()));
}

void WindowDialogs::closeExport() {
  delete export_;  // cancels a running export
  export_ = nullptr;
}

}  // namespace scantrove
