// The menus, the tool bar, and the dialogs that they open.
#include <QApplication>
#include <QDockWidget>
#include <QFileInfo>
#include <QMenuBar>
#include <QMessageBox>
#include <QToolBar>
#include <QToolButton>

#include "ui/main_window/catalogue_choice.h"
#include "ui/main_window/coverage_guide.h"
#include "ui/main_window/dock_arrangement.h"
#include "ui/main_window/main_actions.h"
#include "ui/main_window/main_window.h"
#include "ui/main_window/presentation.h"
#include "ui/main_window/recent_sources.h"
#include "ui/main_window/region_controller.h"
#include "ui/main_window/scan_controller.h"
#include "ui/main_window/scene_pane.h"
#include "ui/main_window/view_actions.h"
#include "ui/panels/camera_dialog.h"
#include "ui/panels/export_dialog.h"
#include "ui/panels/file_dialogs.h"
#include "ui/panels/frame_panels.h"
#include "ui/panels/help_dialog.h"
#include "ui/panels/message_bar.h"
#include "ui/panels/object_list_view.h"
#include "ui/panels/object_panel.h"
#include "ui/panels/params_panel.h"
#include "ui/panels/progress_strip.h"
#include "ui/panels/source_dialog.h"
#include "ui/panels/start_page.h"
#include "ui/panels/time_line.h"
#include "ui/theme/icon.h"

namespace scantrove {

void MainWindow::makeMenus() {
  QMenu* file = menuBar()->addMenu(tr("&File"));
  file->addActions({actions_->open_folder, actions_->open_recording, actions_->open_with_options});
  file->addAction(actions_->open_session);
  file->addAction(actions_->open_camera);
  QMenu* demo = file->addMenu(icon(QStringLiteral("cube")), tr("&Demo"));
  demo->addActions({actions_->open_tabletop, actions_->open_room});
  recent_ = file->addMenu(icon(QStringLiteral("clock")), tr("R&ecent"));
  recent_->setObjectName(QStringLiteral("recentMenu"));
  // Filled as it opens: while it is open nothing moves under the mouse.
  connect(file, &QMenu::aboutToShow, this, &MainWindow::fillRecentMenu);
  file->addSeparator();
  file->addAction(actions_->export_data);
  file->addSeparator();
  file->addAction(actions_->open_catalogue);
  file->addSeparator();
  file->addActions({actions_->close_scan, actions_->quit});

  QMenu* scan = menuBar()->addMenu(tr("&Scan"));
  scan->addActions({actions_->start, actions_->pause, actions_->step, actions_->stop});
  scan->addSeparator();
  scan->addActions({actions_->refine, actions_->skip_refinement});

  const ObjectPanel::Actions& objects = objects_->actions();
  QMenu* edit = menuBar()->addMenu(tr("&Objects"));
  edit->addActions({objects.rename, objects.confirm, objects.merge, objects.remove});
  connect(edit, &QMenu::aboutToHide, objects_, &ObjectPanel::updateActions, Qt::QueuedConnection);
  edit->addSeparator();
  edit->addAction(actions_->focus_objects);

  RegionActions& of_regions = regions_->actions();
  QMenu* regions = menuBar()->addMenu(tr("&Regions"));
  regions->addActions(of_regions.onSelection());
  QMenu* recent_names = regions->addMenu(tr("Recent &names"));
  recent_names->addActions(of_regions.recent);
  regions->addSeparator();
  regions->addActions({of_regions.next, of_regions.previous});
  regions->addSeparator();
  regions->addActions({actions_->undo, actions_->redo});

  QMenu* view = menuBar()->addMenu(tr("&View"));
  view->addActions({scene_->followAction(), scene_->fitAction(), scene_->gridAction(), guide_->action()});
  view->addSeparator();
  scene_->viewActions()->addTo(view);
  view->addSeparator();
  view->addActions({actions_->next_picture, actions_->frame_back, actions_->frame_on});
  view->addSeparator();
  for (const QDockWidget* dock : docks_->docks()) view->addAction(dock->toggleViewAction());
  view->addActions({actions_->reset_layout, actions_->present});
  view->addSeparator();
  QMenu* theme = view->addMenu(tr("&Colours"));
  theme->addActions({actions_->theme_system, actions_->theme_light, actions_->theme_dark});
  menuBar()->addMenu(tr("&Help"))->addActions({actions_->help_keys, actions_->about});
  // What a command does is said beside it; the status line goes on saying how the scan is.
  for (QMenu* menu : menuBar()->findChildren<QMenu*>()) menu->setToolTipsVisible(true);
}

void MainWindow::makeToolBar() {
  QToolBar* bar = addToolBar(tr("Scan"));
  bar->setObjectName(QStringLiteral("scanToolBar"));
  bar->setMovable(false);
  bar->setContextMenuPolicy(Qt::PreventContextMenu);
  bar->toggleViewAction()->setVisible(false);
  bar->setIconSize({20, 20});
  auto* open_button = new QToolButton;
  open_button->setText(tr("Open"));
  open_button->setIcon(icon(QStringLiteral("folder")));
  open_button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  open_button->setPopupMode(QToolButton::InstantPopup);
  open_button->setToolTip(tr("Open a recording, a camera or the demo"));
  auto* open_menu = new QMenu(open_button);
  open_menu->addActions({actions_->open_folder, actions_->open_recording, actions_->open_camera});
  open_menu->addSeparator();
  open_menu->addActions({actions_->open_tabletop, actions_->open_room});
  open_button->setMenu(open_menu);
  bar->addWidget(open_button);
  bar->addSeparator();
  bar->addActions({actions_->start, actions_->pause, actions_->step, actions_->stop});
  bar->addSeparator();
  progress_ = new ProgressStrip(actions_->skip_refinement);
  bar->addWidget(progress_);
  bar->addSeparator();
  bar->addActions({actions_->undo, actions_->redo});
  bar->addSeparator();
  bar->addAction(actions_->help_keys);
}

void MainWindow::connectActions() {
  const auto on = [this](QAction* action, auto slot) { connect(action, &QAction::triggered, this, slot); };
  on(actions_->open_folder, [this] { openFolder(); });
  on(actions_->open_recording, [this] { openRecording(); });
  on(actions_->open_with_options, [this] { openWithOptions(); });
  on(actions_->open_camera, [this] { openCamera(); });
  on(actions_->open_tabletop, [this] { open(QStringLiteral("demo")); });
  on(actions_->open_room, [this] { open(QStringLiteral("demo:room")); });
  on(actions_->open_catalogue, [this] { chooseCatalogue(); });
  on(actions_->open_session, [this] { chooseSession(); });
  on(actions_->export_data, [this] { showExport(); });
  on(actions_->next_picture, [this] { frames_->featureNext(); });
  on(actions_->frame_back, [this] { time_line_->step(-1); });
  on(actions_->frame_on, [this] { time_line_->step(1); });
  on(actions_->close_scan, [this] { closeScan(); });
  on(actions_->quit, [this] { close(); });
  on(actions_->start, [this] { controller_->start(); });
  on(actions_->pause, [this] { controller_->togglePause(); });
  on(actions_->step, [this] { controller_->step(); });
  on(actions_->stop, [this] { controller_->stop(); });
  on(actions_->skip_refinement, [this] { controller_->bridge().post(SkipRefinement{}); });
  on(actions_->refine, [this] { controller_->refine(); });
  on(actions_->focus_objects, [this] {
    docks_->docks().first()->show();
    objects_->list()->setFocus(Qt::ShortcutFocusReason);
    if (!objects_->list()->currentIndex().isValid()) objects_->list()->selectNewest();
  });
  on(actions_->theme_system, [this] { chooseTheme(ThemeChoice::system); });
  on(actions_->theme_light, [this] { chooseTheme(ThemeChoice::light); });
  on(actions_->theme_dark, [this] { chooseTheme(ThemeChoice::dark); });
  on(actions_->reset_layout, [this] { docks_->arrangeAsUsual(); });
  on(actions_->present, [this] { presentation_->begin(); });
  on(actions_->help_keys, [this] { showHelp(); });
  on(actions_->about, [this] { showAbout(); });
  const ThemeChoice theme = Theme::instance().choice();
  (theme == ThemeChoice::dark
       ? actions_->theme_dark
       : (theme == ThemeChoice::light ? actions_->theme_light : actions_->theme_system))
      ->setChecked(true);

  connect(start_, &StartPage::folderRequested, this, &MainWindow::openFolder);
  connect(start_, &StartPage::recordingRequested, this, &MainWindow::openRecording);
  connect(start_, &StartPage::cameraRequested, this, &MainWindow::openCamera);
  connect(start_, &StartPage::sourceChosen, this, &MainWindow::open);
  connect(params_, &ParamsPanel::changed, controller_, &ScanController::setParams);
}

void MainWindow::fillRecentMenu() {
  recent_->clear();
  for (const QString& source : recentSources()) {
    QAction* action = recent_->addAction(sourceTitle(source), this, [this, source] { open(source); });
    action->setToolTip(source);
  }
  recent_->setEnabled(!recent_->isEmpty());
  if (recent_->isEmpty()) return;
  recent_->addSeparator();
  recent_->addAction(tr("Forget these"), this, [this] {
    forgetRecentSources();
    start_->setRecent({});
  });
}

void MainWindow::openFolder() {
  const QString folder = chooseFolder(this, tr("Folder of a recording"));
  if (!folder.isEmpty()) open(folder);
}

void MainWindow::openRecording() {
  const QString file = chooseFile(this, tr("Recording"), tr("OpenNI recordings (*.oni)"));
  if (!file.isEmpty()) open(file);
}

void MainWindow::openWithOptions() {
  SourceDialog dialog(controller_->source(), this);
  if (dialog.exec() != QDialog::Accepted) return;
  messages_->dismiss();
  controller_->open(dialog.source(), dialog.options(), dialog.poses());
}

void MainWindow::openCamera() {
  CameraDialog dialog(listCameras, this);
  if (dialog.exec() == QDialog::Accepted && !dialog.source().isEmpty()) open(dialog.source());
}

void MainWindow::chooseCatalogue() {
  const QString file = chooseFileToSave(this, tr("Catalogue to open or create"), catalogue_->chosen(),
                                        tr("Catalogues (*.sqlite)"));
  if (!file.isEmpty()) openCatalogue(file);
}

void MainWindow::chooseSession() {
  const QString folder = chooseFolder(this, tr("Scan that was kept"), ScanController::sessionsFolder());
  if (!folder.isEmpty()) openSession(folder);
}

void MainWindow::showExport() {
  if (export_ != nullptr && export_->isWorking()) {
    export_->raise();
    return;
  }
  delete export_;
  export_ = new ExportDialog(QFileInfo(controller_->sessionFolder()).fileName(), this);
  ScanBridge& bridge = controller_->bridge();
  connect(export_, &ExportDialog::posted, &bridge, &ScanBridge::post);
  connect(&bridge, &ScanBridge::eventArrived, export_, &ExportDialog::handleEvent);
  export_->show();
  export_->raise();
  export_->activateWindow();
}

void MainWindow::showHelp() {
  if (help_ == nullptr) help_ = new HelpDialog(this);
  help_->show();
  help_->raise();
  help_->activateWindow();
}

void MainWindow::showAbout() {
  QMessageBox::about(this, tr("About Scantrove"),
                     tr("<h3>Scantrove %1</h3><p>Sweep a depth camera over a scene, collect its objects in a "
                        "database.</p>")
                         .arg(QApplication::applicationVersion()));
}

}  // namespace scantrove
