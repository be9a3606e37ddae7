#include "ui/main_window/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QMimeData>
#include <QSettings>
#include <QSplitter>
#include <QStackedWidget>
#include <QStatusBar>
#include <QVBoxLayout>

#include "core/project/opened_path.h"
#include "ui/main_window/coverage_guide.h"
#include "ui/main_window/dock_arrangement.h"
#include "ui/main_window/main_actions.h"
#include "ui/main_window/main_menus.h"
#include "ui/main_window/next_step_guide.h"
#include "ui/main_window/object_pages.h"
#include "ui/main_window/presentation.h"
#include "ui/main_window/project_choice.h"
#include "ui/main_window/project_page.h"
#include "ui/main_window/recent_sources.h"
#include "ui/main_window/region_controller.h"
#include "ui/main_window/review_controller.h"
#include "ui/main_window/scan_controller.h"
#include "ui/main_window/scan_display.h"
#include "ui/main_window/scene_names.h"
#include "ui/main_window/scene_pane.h"
#include "ui/main_window/selection_link.h"
#include "ui/main_window/shape_watch.h"
#include "ui/main_window/window_dialogs.h"
#include "ui/main_window/window_placement.h"
#include "ui/painting/image_mode.h"
#include "ui/painting/image_page.h"
#include "ui/panels/color_panel.h"
#include "ui/panels/floating_bars.h"
#include "ui/panels/frame_panels.h"
#include "ui/panels/history_panel.h"
#include "ui/panels/message_bar.h"
#include "ui/panels/next_step_strip.h"
#include "ui/panels/object_list_view.h"
#include "ui/panels/object_panel.h"
#include "ui/panels/params_panel.h"
#include "ui/panels/progress_strip.h"
#include "ui/panels/proposal_bar.h"
#include "ui/panels/start_page.h"
#include "ui/panels/status_strip.h"
#include "ui/panels/time_line.h"
#include "ui/theme/icon.h"

namespace scantrove {
namespace {
const QString kGeometryKey = QStringLiteral("window/geometry");
constexpr int kObjectsWidth = 290;
constexpr int kFramesWidth = 480;
constexpr int kOtherPrograms_ms = 1000;  ///< interval for reading their changes of the catalogue
constexpr int kListInUse_ms = 50;
}  // namespace

MainWindow::MainWindow(const ScanPortFactory& factory, const WindowOptions& options)
    : editor_(history_),
      model_(editor_),
      controller_(new ScanController(factory, options, this)),
      project_(new ProjectChoice(editor_, *controller_, this)),
      dialogs_(new WindowDialogs(*this)) {
  parts_.actions = new MainActions(history_.stack(), this);
  setWindowIcon(icon(QStringLiteral("scantrove")));
  setAcceptDrops(true);
  makeCenter();
  makeDocks(options.params);
  regions_ = new RegionController(controller_->bridge(), *parts_.scene, *parts_.frames, history_, *this);
  parts_.review = new ReviewController(*parts_.time_line, regions_->operations(), this);
  guide_ = new CoverageGuide(regions_->selection(), *parts_.scene, model_, this);
  parts_.names = new SceneNames(regions_->selection(), *parts_.scene, *parts_.frames, this);
  docks_->add({tr("History"), "historyDock", tr("Ctrl+4"), Qt::RightDockWidgetArea, kFramesWidth, true},
              new HistoryPanel(history_.stack()));
  presentation_ = new Presentation(*this);
  parts_.progress = new ProgressStrip(parts_.actions->skip_refinement);
  parts_.status = new StatusStrip;
  statusBar()->addWidget(parts_.status, 1);
  statusBar()->setSizeGripEnabled(false);
  statusBar()->setContentsMargins(0, 0, 0, 0);
  parts_.project_page = new ProjectPage(*this);
  new MainMenus(*this);
  new ScanDisplay(*this);
  new NextStepGuide(*this);
  new ObjectPages(*this);
  new ShapeWatch(*this);
  connectRegions();

  resize(1480, 920);
  if (options.width > 0 && options.height > 0) {
    resize(options.width, options.height);
  } else {
    restoreGeometry(QSettings().value(kGeometryKey).toByteArray());
    fitToScreen(*this);
  }
  docks_->restore();
  if (options.width <= 0) fitToScreen(*this);  // folded docks need less room
  showStartPage();
  connectCatalogue();
  project_->openAtStart(QString::fromStdString(options.project), QString::fromStdString(options.database));
}

MainWindow::~MainWindow() {
  // Ends the scan and its events before widgets are destroyed.
  delete controller_;
}

void MainWindow::makeCenter() {
  auto* column = new QWidget;
  auto* layout = new QVBoxLayout(column);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  parts_.messages = new MessageBar(column);
  center_ = new QStackedWidget;
  parts_.start = new StartPage;
  parts_.scene = new ScenePane;
  center_->addWidget(parts_.start);
  auto* work = new QSplitter;
  work->setChildrenCollapsible(false);
  parts_.image = new ImagePage;
  work->addWidget(parts_.image);
  work->addWidget(parts_.scene);
  center_->addWidget(work);
  layout->addWidget(center_, 1);
  parts_.time_line = new TimeLine;
  layout->addWidget(parts_.time_line);
  parts_.next_steps = new NextStepStrip;
  layout->addWidget(parts_.next_steps);
  setCentralWidget(column);
}

void MainWindow::makeDocks(const ScanParams& params) {
  docks_ = new DockArrangement(*this);
  parts_.objects = new ObjectPanel(editor_, model_);
  parts_.frames = new FramePanels;
  parts_.frames->colorPanel()->setNameOf([this](ObjectId object) {
    const ObjectRecord* const record = model_.record(object);
    return record != nullptr ? QString::fromStdString(record->name) : QString();
  });
  parts_.frames->colorPanel()->setIsRecognized(
      [this](ObjectId object) { return model_.isRecognized(object); });
  parts_.params = new ParamsPanel(params);
  docks_->add({tr("Objects"), "objectsDock", tr("Ctrl+1"), Qt::LeftDockWidgetArea, kObjectsWidth, false},
              parts_.objects);
  docks_->add({tr("Settings"), "settingsDock", tr("Ctrl+3"), Qt::LeftDockWidgetArea, kObjectsWidth, true},
              parts_.params);
  docks_->add({tr("Current frame"), "framesDock", tr("Ctrl+2"), Qt::RightDockWidgetArea, kFramesWidth, true},
              parts_.frames);
}

bool MainWindow::onStartPage() const { return center_->currentWidget() == parts_.start; }

void MainWindow::showStartPage() {
  project_->showChosen();
  regions_->beginScan();  // clears questions, undo steps and selection of the scan
  parts_.start->setRecent(recentSources());
  parts_.project_page->refresh();
  center_->setCurrentWidget(parts_.start);
  docks_->setScanShown(false);
  showTitle({});
  parts_.progress->clear();
  parts_.time_line->clear();
  parts_.next_steps->beginScan();
}

void MainWindow::closeScan() {
  if (!parts_.objects->list()->finishEditing()) return;
  regions_->finishEditing();
  dialogs_->closeExport();
  controller_->close();
  parts_.actions->enableReview(false);
  parts_.actions->enableRefinement(false);
  parts_.actions->enableFor(controller_->bridge().state(), controller_->hasSource());
  parts_.status->showState(ScanState::idle);
  showStartPage();
}

void MainWindow::showTitle(const QString& scan) {
  QStringList parts;
  if (!scan.isEmpty()) parts << scan;
  if (project_->project().catalogue != defaultProject().catalogue) parts << project_->name();
  parts << QStringLiteral("Scantrove");
  setWindowTitle(parts.join(QStringLiteral(" — ")));
}

void MainWindow::showProject() {
  parts_.start->setProject(project_->name(), project_->place());
  if (!onStartPage()) return;
  showTitle({});
  parts_.project_page->refresh();
}

void MainWindow::showScene() {
  if (!onStartPage()) return;
  center_->setCurrentIndex(1);  // 3D view and image
  docks_->setScanShown(true);
}

void MainWindow::open(const QString& source) {
  if (!parts_.objects->list()->finishEditing()) return;
  parts_.messages->dismiss();
  const OpenedPath path = recognizePath(source.toStdString());
  const QString folder = QString::fromStdString(path.folder.string());
  if (path.kind == OpenedPath::Kind::project) return openProjectFolder(folder);
  if (path.kind == OpenedPath::Kind::scan) return controller_->openSession(folder);
  controller_->open(source);
}

void MainWindow::openSession(const QString& folder) {
  if (!parts_.objects->list()->finishEditing()) return;
  parts_.messages->dismiss();
  const OpenedPath path = recognizePath(folder.toStdString());
  const bool is_scan = path.kind == OpenedPath::Kind::scan;
  controller_->openSession(is_scan ? QString::fromStdString(path.folder.string()) : folder);
}

bool MainWindow::leavesScan() {
  if (!parts_.objects->list()->finishEditing()) return false;
  parts_.messages->dismiss();
  if (!onStartPage()) closeScan();
  return true;
}

void MainWindow::openProjectFolder(const QString& folder) {
  if (leavesScan()) project_->open(folder);
}

void MainWindow::createProjectFolder(const QString& folder) {
  if (leavesScan()) project_->create(folder);
}

void MainWindow::openCatalogue(const QString& file) {
  if (!parts_.objects->list()->finishEditing()) return;
  project_->chooseCatalogue(file, !onStartPage());
}

void MainWindow::connectRegions() {
  ScanBridge& bridge = controller_->bridge();
  connect(regions_, &RegionController::failed, this,
          [this](const QString& message) { parts_.messages->show(MessageBar::Kind::warning, message); });
  connect(regions_, &RegionController::hinted, this,
          [this](const QString& message) { parts_.messages->show(MessageBar::Kind::info, message); });
  connect(controller_, &ScanController::failed, this,
          [this](const QString& message) { parts_.messages->show(MessageBar::Kind::warning, message); });
  parts_.image_mode = new ImageMode({bridge, *parts_.image, *parts_.frames, *parts_.scene,
                                     regions_->selection(), *parts_.actions->image_mode},
                                    this);
  regions_->connectImage(*parts_.image_mode);
  connect(parts_.image_mode, &ImageMode::cameraShown, parts_.scene->view(), &SceneView::lookFromCamera);
  const RegionActions& on_regions = regions_->actions();
  auto* proposals = new ProposalBar(regions_->operations().proposals(), on_regions.accept,
                                    on_regions.accept_all, on_regions.not_this, centralWidget());
  auto* bars = new FloatingBars(*center_);
  bars->add(*parts_.messages);
  bars->add(*proposals);
  regions_->naming().setCatalogue([this] { return editor_.catalogue(); });
  connect(parts_.time_line, &TimeLine::requested, &bridge,
          [&bridge](int index) { bridge.post(ShowKeyFrame{index}); });
}

void MainWindow::connectCatalogue() {
  ScanBridge& bridge = controller_->bridge();
  catalogue_timer_.setSingleShot(true);
  connect(project_, &ProjectChoice::changed, this, &MainWindow::showProject);
  connect(&catalogue_timer_, &QTimer::timeout, this, &MainWindow::readCatalogueChanges);
  connect(project_, &ProjectChoice::warned, this,
          [this](const QString& message) { parts_.messages->show(MessageBar::Kind::warning, message); });
  connect(project_, &ProjectChoice::failed, this,
          [this](const QString& message) { parts_.messages->show(MessageBar::Kind::error, message); });
  const auto soon = [this] { catalogue_timer_.start(0); };
  bridge.on<ObjectAdded>(this, soon);
  bridge.on<ViewAdded>(this, soon);
  bridge.on<ObjectsMerged>(this, soon);
  bridge.on<ObjectNamed>(this, soon);
  bridge.on<StateChanged>(this, soon);
  connect(&editor_, &CatalogueEditor::edited, &bridge, [&bridge] { bridge.post(ApplyCatalogueChanges{}); });
  connect(&editor_, &CatalogueEditor::failed, this,
          [this](const QString& message) { parts_.messages->show(MessageBar::Kind::error, message); });
  connect(&model_, &ObjectListModel::dataChanged, parts_.frames->colorPanel(), qOverload<>(&QWidget::update));
  new SelectionLink(regions_->selection(), *parts_.objects, *parts_.frames, this);
  catalogue_timer_.start(kOtherPrograms_ms);
}

void MainWindow::readCatalogueChanges() {
  const bool wait = parts_.objects->list()->isPressed();
  if (!wait) editor_.poll();
  catalogue_timer_.start(wait ? kListInUse_ms : kOtherPrograms_ms);
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!parts_.objects->list()->finishEditing()) {
    event->ignore();
    return;
  }
  regions_->finishEditing();
  QSettings().setValue(kGeometryKey, saveGeometry());
  docks_->save();
  controller_->stop();
  event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls() && event->mimeData()->urls().first().isLocalFile())
    event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  const QList<QUrl> urls = event->mimeData()->urls();
  if (urls.isEmpty()) return;
  event->acceptProposedAction();
  const QString path = urls.first().toLocalFile();
  open(path);
}

}  // namespace scantrove
