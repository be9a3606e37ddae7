#include "ui/main_window/main_menus.h"

#include <QDockWidget>
#include <QFileInfo>
#include <QLineEdit>
#include <QMenuBar>
#include <QSettings>
#include <QToolBar>
#include <QToolButton>

#include "ui/main_window/coverage_guide.h"
#include "ui/main_window/dock_arrangement.h"
#include "ui/main_window/guide_opener.h"
#include "ui/main_window/language_menu.h"
#include "ui/main_window/main_actions.h"
#include "ui/main_window/main_window.h"
#include "ui/main_window/picture_saver.h"
#include "ui/main_window/presentation.h"
#include "ui/main_window/project_choice.h"
#include "ui/main_window/project_page.h"
#include "ui/main_window/recent_sources.h"
#include "ui/main_window/region_controller.h"
#include "ui/main_window/review_controller.h"
#include "ui/main_window/scan_controller.h"
#include "ui/main_window/scene_names.h"
#include "ui/main_window/scene_pane.h"
#include "ui/main_window/view_actions.h"
#include "ui/main_window/window_dialogs.h"
#include "ui/models/plain_text.h"
#include "ui/panels/frame_panels.h"
#include "ui/panels/message_bar.h"
#include "ui/panels/object_filter_bar.h"
#include "ui/panels/object_list_view.h"
#include "ui/panels/object_panel.h"
#include "ui/panels/params_panel.h"
#include "ui/panels/progress_strip.h"
#include "ui/panels/start_page.h"
#include "ui/panels/time_line.h"
#include "ui/theme/icon.h"

namespace scantrove {

MainMenus::MainMenus(MainWindow& window) : QObject(&window), window_(window), parts_(window.parts()) {
  makeMenus();
  makeToolBar();
  connectActions();
}

void MainMenus::makeMenus() {
  const MainActions& actions = *parts_.actions;
  QMenu* file = window_.menuBar()->addMenu(tr("&File"));
  file->addActions({actions.open_folder, actions.open_recording, actions.open_with_options});
  file->addAction(actions.open_session);
  file->addAction(actions.open_camera);
  QMenu* demo = file->addMenu(icon(QStringLiteral("cube")), tr("&Demo"));
  demo->addActions({actions.open_tabletop, actions.open_room});
  recent_ = file->addMenu(icon(QStringLiteral("clock")), tr("Scan &again"));
  recent_->setObjectName(QStringLiteral("recentMenu"));
  // Filled when it opens, so that it does not change while open.
  connect(file, &QMenu::aboutToShow, this, &MainMenus::fillRecentMenu);
  connect(file, &QMenu::aboutToShow, this, &MainMenus::fillRecentProjects);
  file->addSeparator();
  file->addAction(actions.export_data);
  file->addSeparator();
  file->addActions({actions.open_project, actions.new_project});
  recent_projects_ = file->addMenu(tr("Recent &projects"));
  recent_projects_->setObjectName(QStringLiteral("recentProjectsMenu"));
  file->addActions({actions.open_catalogue, actions.connect_catalogue});
  file->addSeparator();
  file->addActions({actions.close_scan, actions.quit});

  QMenu* edit = window_.menuBar()->addMenu(tr("&Edit"));
  edit->addActions({actions.undo, actions.redo});
  edit->addSeparator();
  edit->addAction(actions.classes);

  QMenu* scan = window_.menuBar()->addMenu(tr("&Scan"));
  scan->addActions({actions.start, actions.pause, actions.step, actions.stop});
  scan->addSeparator();
  scan->addActions({actions.continue_scan, actions.refine, actions.skip_refinement});
  scan->addSeparator();
  scan->addActions({actions.save_picture, actions.save_video});

  const ObjectPanel::Actions& objects = parts_.objects->actions();
  QMenu* object_menu = window_.menuBar()->addMenu(tr("&Objects"));
  object_menu->addActions({objects.page, objects.rename, objects.confirm, objects.merge, objects.remove});
  connect(object_menu, &QMenu::aboutToHide, parts_.objects, &ObjectPanel::updateActions,
          Qt::QueuedConnection);
  object_menu->addSeparator();
  object_menu->addActions({parts_.objects->filterBar()->findAction(), actions.focus_objects});

  RegionActions& of_regions = window_.regions().actions();
  QMenu* regions = window_.menuBar()->addMenu(tr("&Regions"));
  regions->addActions(of_regions.onSelection());
  QMenu* recent_names = regions->addMenu(tr("&Recent names"));
  recent_names->addActions(of_regions.recent);
  regions->addSeparator();
  regions->addAction(of_regions.mark_supports);
  regions->addSeparator();
  regions->addActions({of_regions.next, of_regions.previous});

  QMenu* review = window_.menuBar()->addMenu(tr("Revie&w"));
  review->addActions({actions.frame_back, actions.frame_on});
  review->addSeparator();
  review->addActions(parts_.review->actions());

  QMenu* view = window_.menuBar()->addMenu(tr("&View"));
  view->addActions({parts_.scene->followAction(), parts_.scene->fitAction(), parts_.scene->gridAction(),
                    window_.guide().action(), parts_.names->action()});
  view->addSeparator();
  parts_.scene->viewActions()->addTo(view);
  view->addSeparator();
  view->addActions({actions.image_mode, actions.next_picture});
  view->addSeparator();
  for (const QDockWidget* dock : window_.docks().docks()) view->addAction(dock->toggleViewAction());
  view->addActions({actions.reset_layout, actions.present});
  view->addSeparator();
  QMenu* theme = view->addMenu(tr("&Theme"));
  theme->addActions({actions.theme_system, actions.theme_light, actions.theme_dark});
  auto* language = new LanguageMenu(view);
  view->addMenu(language);
  connect(language, &LanguageMenu::noticed, this,
          [this](const QString& notice) { parts_.messages->show(MessageBar::Kind::info, notice); });
  auto* guide = new GuideOpener(window_);
  window_.menuBar()->addMenu(tr("&Help"))->addActions({guide->action(), actions.help_keys, actions.about});
  // Tooltips describe the commands, because the status line shows the state of the scan.
  for (QMenu* menu : window_.menuBar()->findChildren<QMenu*>()) menu->setToolTipsVisible(true);
}

void MainMenus::makeToolBar() {
  const MainActions& actions = *parts_.actions;
  QToolBar* bar = window_.addToolBar(tr("Scan"));
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
  open_menu->addActions({actions.open_folder, actions.open_recording, actions.open_camera});
  open_menu->addSeparator();
  open_menu->addActions({actions.open_tabletop, actions.open_room});
  open_button->setMenu(open_menu);
  bar->addWidget(open_button);
  bar->addSeparator();
  bar->addActions({actions.start, actions.pause, actions.step, actions.stop});
  bar->addSeparator();
  bar->addWidget(parts_.progress);
  bar->addSeparator();
  bar->addActions({actions.undo, actions.redo});
  bar->addSeparator();
  bar->addAction(actions.image_mode);
  bar->addSeparator();
  bar->addAction(actions.help_keys);
}

void MainMenus::connectActions() {
  const MainActions& actions = *parts_.actions;
  const auto on = [this](QAction* action, auto slot) { connect(action, &QAction::triggered, this, slot); };
  on(actions.open_folder, [this] { window_.dialogs().openFolder(); });
  on(actions.open_recording, [this] { window_.dialogs().openRecording(); });
  on(actions.open_with_options, [this] { window_.dialogs().openWithOptions(); });
  on(actions.open_camera, [this] { window_.dialogs().openCamera(); });
  on(actions.open_tabletop, [this] { window_.open(QStringLiteral("demo")); });
  on(actions.open_room, [this] { window_.open(QStringLiteral("demo:room")); });
  on(actions.open_project, [this] { window_.dialogs().openProject(); });
  on(actions.new_project, [this] { window_.dialogs().newProject(); });
  on(actions.open_catalogue, [this] { window_.dialogs().chooseCatalogue(); });
  on(actions.connect_catalogue, [this] { window_.dialogs().connectCatalogue(); });
  on(actions.open_session, [this] { window_.dialogs().chooseSession(); });
  on(actions.export_data, [this] { window_.dialogs().showExport(); });
  on(actions.next_picture, [this] { parts_.frames->featureNext(); });
  on(actions.frame_back, [this] { parts_.time_line->step(-1); });
  on(actions.frame_on, [this] { parts_.time_line->step(1); });
  on(actions.close_scan, [this] { window_.closeScan(); });
  on(actions.quit, [this] { window_.close(); });
  on(actions.start, [this] { window_.controller().start(); });
  on(actions.pause, [this] { window_.controller().togglePause(); });
  on(actions.step, [this] { window_.controller().step(); });
  on(actions.stop, [this] { window_.controller().stop(); });
  on(actions.skip_refinement, [this] { window_.controller().bridge().post(SkipRefinement{}); });
  auto* pictures = new PictureSaver(window_);
  connect(actions.save_picture, &QAction::triggered, pictures, &PictureSaver::savePicture);
  connect(actions.save_video, &QAction::triggered, pictures, &PictureSaver::saveVideo);
  on(actions.refine, [this] { window_.controller().refine(); });
  on(actions.continue_scan,
     [this] { parts_.project_page->continueScan(window_.controller().sessionFolder()); });
  on(actions.focus_objects, [this] {
    window_.docks().docks().first()->show();
    parts_.objects->list()->setFocus(Qt::ShortcutFocusReason);
    if (!parts_.objects->list()->currentIndex().isValid()) parts_.objects->list()->selectNewest();
  });
  on(parts_.objects->filterBar()->findAction(), [this] {
    window_.docks().docks().first()->show();
    parts_.objects->filterBar()->search()->setFocus(Qt::ShortcutFocusReason);
    parts_.objects->filterBar()->search()->selectAll();
  });
  on(actions.theme_system, [this] { chooseTheme(ThemeChoice::system); });
  on(actions.theme_light, [this] { chooseTheme(ThemeChoice::light); });
  on(actions.theme_dark, [this] { chooseTheme(ThemeChoice::dark); });
  on(actions.reset_layout, [this] { window_.docks().resetLayout(); });
  on(actions.present, [this] { window_.presentation()->begin(); });
  on(actions.classes, [this] { window_.dialogs().showClasses(); });
  on(actions.help_keys, [this] { window_.dialogs().showHelp(); });
  on(actions.about, [this] { window_.dialogs().showAbout(); });
  const ThemeChoice theme = Theme::instance().choice();
  (theme == ThemeChoice::dark ? actions.theme_dark
                              : (theme == ThemeChoice::light ? actions.theme_light : actions.theme_system))
      ->setChecked(true);

  connect(parts_.start, &StartPage::projectRequested, &window_.dialogs(), &WindowDialogs::openProject);
  connect(parts_.start, &StartPage::newProjectRequested, &window_.dialogs(), &WindowDialogs::newProject);
  connect(parts_.start, &StartPage::folderRequested, &window_.dialogs(), &WindowDialogs::openFolder);
  connect(parts_.start, &StartPage::recordingRequested, &window_.dialogs(), &WindowDialogs::openRecording);
  connect(parts_.start, &StartPage::cameraRequested, &window_.dialogs(), &WindowDialogs::openCamera);
  connect(parts_.start, &StartPage::sourceChosen, &window_, &MainWindow::open);
  connect(parts_.params, &ParamsPanel::changed, &window_.controller(), &ScanController::setParams);
}

void MainMenus::fillRecentMenu() {
  recent_->clear();
  for (const QString& source : recentSources()) {
    QAction* action = recent_->addAction(sourceTitle(source), this, [this, source] { window_.open(source); });
    action->setToolTip(plainTip(source));
  }
  recent_->setEnabled(!recent_->isEmpty());
  if (recent_->isEmpty()) return;
  recent_->addSeparator();
  recent_->addAction(tr("Clear list"), this, [this] {
    clearRecentSources();
    parts_.start->setRecent({});
  });
}

void MainMenus::fillRecentProjects() {
  recent_projects_->clear();
  for (const QString& place : ProjectChoice::recent()) {
    const bool is_folder = QFileInfo(place).isDir();
    QAction* action =
        recent_projects_->addAction(ProjectChoice::titleOf(place), this, [this, place, is_folder] {
          is_folder ? window_.openProjectFolder(place) : window_.openCatalogue(place);
        });
    action->setToolTip(plainTip(place));
  }
  recent_projects_->setEnabled(!recent_projects_->isEmpty() && parts_.actions->open_project->isEnabled());
}

void MainMenus::chooseTheme(ThemeChoice choice) {
  Theme::instance().choose(choice);
  QSettings().setValue(QStringLiteral("theme"), static_cast<int>(choice));
}

}  // namespace scantrove
