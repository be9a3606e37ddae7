#include "ui/main_window/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QMimeData>
#include <QSettings>
#include <QStackedWidget>
#include <QStatusBar>
#include <QVBoxLayout>

#include "ui/main_window/catalogue_choice.h"
#include "ui/main_window/coverage_guide.h"
#include "ui/main_window/dock_arrangement.h"
#include "ui/main_window/main_actions.h"
#include "ui/main_window/presentation.h"
#include "ui/main_window/recent_sources.h"
#include "ui/main_window/region_controller.h"
#include "ui/main_window/saved_scan_list.h"
#include "ui/main_window/scan_controller.h"
#include "ui/main_window/scene_pane.h"
#include "ui/main_window/window_placement.h"
#include "ui/panels/color_panel.h"
#include "ui/panels/export_dialog.h"
#include "ui/panels/frame_panels.h"
#include "ui/panels/history_panel.h"
#include "ui/panels/message_bar.h"
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
constexpr int kOtherPrograms_ms = 1000;  ///< what they write is seen after that
constexpr int kHeldList_ms = 50;
}  // namespace

MainWindow::MainWindow(const ScanPortFactory& factory, const WindowOptions& options)
    : editor_(history_),
      model_(editor_),
      controller_(new ScanController(factory, options, this)),
      catalogue_(new CatalogueChoice(editor_, *controller_, this)),
      actions_(new MainActions(history_.stack(), this)) {
  setWindowTitle(QStringLiteral("Scantrove"));
  setWindowIcon(icon(QStringLiteral("scantrove")));
  setAcceptDrops(true);
  makeCenter();
  makeDocks(options.params);
  regions_ = new RegionController(controller_->bridge(), *scene_, *frames_, history_, *this);
  guide_ = new CoverageGuide(regions_->selection(), *scene_, model_, this);
  docks_->add({tr("History"), "historyDock", tr("Ctrl+4"), Qt::RightDockWidgetArea, kFramesWidth, true},
              new HistoryPanel(history_.stack()));
  presentation_ = new Presentation(*this);
  makeMenus();
  makeToolBar();
  status_ = new StatusStrip;
  statusBar()->addWidget(status_, 1);
  statusBar()->setSizeGripEnabled(false);
  statusBar()->setContentsMargins(0, 0, 0, 0);
  connectActions();
  connectSession();
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
  catalogue_->openAtStart(QString::fromStdString(options.database));
}

MainWindow::~MainWindow() {
  // The scan ends, and with it all news, before the first widget goes.
  delete controller_;
}

void MainWindow::makeCenter() {
  auto* column = new QWidget;
  auto* layout = new QVBoxLayout(column);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  messages_ = new MessageBar(column);
  center_ = new QStackedWidget;
  start_ = new StartPage;
  scene_ = new ScenePane;
  center_->addWidget(start_);
  center_->addWidget(scene_);
  layout->addWidget(messages_);
  layout->addWidget(center_, 1);
  time_line_ = new TimeLine;
  layout->addWidget(time_line_);
  setCentralWidget(column);
}

void MainWindow::makeDocks(const ScanParams& params) {
  docks_ = new DockArrangement(*this);
  objects_ = new ObjectPanel(editor_, model_);
  frames_ = new FramePanels;
  frames_->colorPanel()->setNameOf([this](ObjectId object) {
    const ObjectRecord* const record = model_.record(object);
    return record != nullptr ? QString::fromStdString(record->name) : QString();
  });
  frames_->colorPanel()->setIsRecognized([this](ObjectId object) { return model_.isRecognized(object); });
  params_ = new ParamsPanel(params);
  docks_->add({tr("Objects"), "objectsDock", tr("Ctrl+1"), Qt::LeftDockWidgetArea, kObjectsWidth, false},
              objects_);
  docks_->add({tr("Settings"), "settingsDock", tr("Ctrl+3"), Qt::LeftDockWidgetArea, kObjectsWidth, true},
              params_);
  docks_->add({tr("Current frame"), "framesDock", tr("Ctrl+2"), Qt::RightDockWidgetArea, kFramesWidth, true},
              frames_);
}

bool MainWindow::onStartPage() const { return center_->currentWidget() == start_; }

void MainWindow::showStartPage() {
  catalogue_->showChosen();
  regions_->beginScan();  // questions, steps and selections end with their scan
  start_->setRecent(recentSources());
  showSavedScans();
  center_->setCurrentWidget(start_);
  docks_->setScanShown(false);
  progress_->clear();
  time_line_->clear();
}

void MainWindow::closeScan() {
  if (!objects_->list()->finishEditing()) return;
  regions_->finishEditing();
  if (export_ != nullptr) {
    delete export_;  // cancels what it waits for
    export_ = nullptr;
  }
  controller_->close();
  actions_->enableReview(false);
  actions_->enableRefinement(false);
  actions_->enableFor(controller_->bridge().state(), controller_->hasSource());
  status_->showState(ScanState::idle);
  setWindowTitle(QStringLiteral("Scantrove"));
  showStartPage();
}

void MainWindow::showSavedScans() {
  start_->savedScans()->setScans(savedScansIn(ScanController::sessionsFolder()));
}

void MainWindow::showScene() {
  if (!onStartPage()) return;
  center_->setCurrentWidget(scene_);
  docks_->setScanShown(true);
}

void MainWindow::open(const QString& source) {
  if (!objects_->list()->finishEditing()) return;
  messages_->dismiss();
  controller_->open(source);
}

void MainWindow::openSession(const QString& folder) {
  if (!objects_->list()->finishEditing()) return;
  messages_->dismiss();
  controller_->openSession(folder);
}

void MainWindow::openCatalogue(const QString& file) {
  if (!objects_->list()->finishEditing()) return;
  catalogue_->choose(file, !onStartPage());
}

void MainWindow::connectSession() {
  ScanBridge& bridge = controller_->bridge();
  connect(controller_, &ScanController::opening, this, &MainWindow::beginScan);
  connect(&bridge, &ScanBridge::snapshotArrived, this,
          [this](const std::shared_ptr<const ScanSnapshot>& snapshot) { showSnapshot(snapshot); });
  bridge.on<StateChanged>(this, [this](StateChanged changed) { showState(changed.state); });
  bridge.on<RefinementStepped>(this, [this](const RefinementStepped& progress) {
    status_->showRefinement(progress.keyFrame(), progress.key_frames);
    progress_->showRefinement(progress);
  });
  bridge.on<PreparingDevice>(this, [this] { status_->showPreparing(); });
  bridge.on<ScanFailed>(this, [this](const ScanFailed& event) { scanFailed(event); });
  const auto warn = [this](const auto& event) {
    messages_->show(MessageBar::Kind::warning, QString::fromStdString(event.error.message()));
  };
  bridge.on<FrameSkipped>(this, warn);
  bridge.on<CatalogueFailed>(this, warn);
  bridge.on<MapFailed>(this, warn);
  bridge.on<MapDrifted>(this, warn);
  bridge.on<ScanAdvice>(this, warn);
  bridge.on<ObjectAdded>(this, [this](const ObjectAdded& added) { model_.markAdded(added.object); });
  bridge.on<ObjectRecognized>(this,
                              [this](const ObjectRecognized& known) { model_.markRecognized(known.object); });
}

void MainWindow::connectRegions() {
  ScanBridge& bridge = controller_->bridge();
  connect(regions_, &RegionController::failed, this,
          [this](const QString& message) { messages_->show(MessageBar::Kind::warning, message); });
  connect(controller_, &ScanController::failed, this,
          [this](const QString& message) { messages_->show(MessageBar::Kind::warning, message); });
  const RegionActions& on_regions = regions_->actions();
  auto* proposals =
      new ProposalBar(regions_->proposals(), on_regions.accept, on_regions.accept_all, on_regions.not_this);
  centralWidget()->layout()->addWidget(proposals);
  regions_->setKnownNames([this] {
    QStringList names;
    for (const ObjectRecord& object : editor_.objects()) {
      if (object.confirmed) names << QString::fromStdString(object.name);
    }
    return names;
  });
  bridge.on<ReviewOpened>(this, [this](ReviewOpened opened) {
    if (onStartPage()) return;  // it was closed meanwhile
    actions_->enableReview(true);
    actions_->enableRefinement(opened.can_refine);
    has_snapshot_ = true;
  });
  connect(start_->savedScans(), &SavedScansPanel::chosen, this, &MainWindow::openSession);
  connect(start_->savedScans(), &SavedScansPanel::deleteRequested, this, [this](const QString& folder) {
    const auto fail = [this](const QString& message) { messages_->show(MessageBar::Kind::error, message); };
    history_.push(start_, std::make_shared<DeleteScan>(
                              folder, [this] { showSavedScans(); }, fail));
  });
  connect(time_line_, &TimeLine::requested, &bridge,
          [&bridge](int place) { bridge.post(ShowKeyFrame{place}); });
}

void MainWindow::connectCatalogue() {
  ScanBridge& bridge = controller_->bridge();
  catalogue_timer_.setSingleShot(true);
  connect(&catalogue_timer_, &QTimer::timeout, this, &MainWindow::followCatalogue);
  connect(catalogue_, &CatalogueChoice::noted, this,
          [this](const QString& message) { messages_->show(MessageBar::Kind::warning, message); });
  connect(catalogue_, &CatalogueChoice::failed, this,
          [this](const QString& message) { messages_->show(MessageBar::Kind::error, message); });
  const auto soon = [this] { catalogue_timer_.start(0); };
  bridge.on<ObjectAdded>(this, soon);
  bridge.on<ViewAdded>(this, soon);
  bridge.on<ObjectsMerged>(this, soon);
  bridge.on<ObjectNamed>(this, soon);
  bridge.on<StateChanged>(this, soon);
  connect(&editor_, &CatalogueEditor::edited, &bridge, [&bridge] { bridge.post(FollowCatalogue{}); });
  connect(&editor_, &CatalogueEditor::failed, this,
          [this](const QString& message) { messages_->show(MessageBar::Kind::error, message); });
  connect(&model_, &ObjectListModel::dataChanged, frames_->colorPanel(), qOverload<>(&QWidget::update));
  connect(objects_, &ObjectPanel::selectionChanged, this, [this](const std::vector<ObjectId>& objects) {
    frames_->setSelected({objects.begin(), objects.end()});
    std::vector<RegionId> regions;
    for (const RegionInfo& region : regions_->selection().infos()) {
      if (region.object && std::ranges::find(objects, region.object) != objects.end())
        regions.push_back(region.region);
    }
    if (!regions.empty()) regions_->selection().select(regions);
  });
  catalogue_timer_.start(kOtherPrograms_ms);
}

void MainWindow::followCatalogue() {
  const bool wait = objects_->list()->isHeld();
  if (!wait) editor_.poll();
  catalogue_timer_.start(wait ? kHeldList_ms : kOtherPrograms_ms);
}

void MainWindow::beginScan(const QString& source) {
  params_->finishTyping();
  controller_->hasSource() ? catalogue_->showChosen() : catalogue_->showCatalogueOf(source);
  setWindowTitle(tr("%1 — Scantrove").arg(sourceTitle(source)));
  progress_->begin(sourceTitle(source));
  scene_->view()->clearScene();
  scene_->view()->scene().setVoxelSize(controller_->request().params.fusion.voxel_size_m);
  frames_->clear();
  regions_->beginScan();
  guide_->beginScan();
  time_line_->clear();
  actions_->enableReview(false);
  actions_->enableRefinement(false);
  model_.beginScan();
  has_snapshot_ = false;
  showScene();
}

void MainWindow::showSnapshot(const std::shared_ptr<const ScanSnapshot>& collected) {
  if (onStartPage()) return;  // of a scan that was closed
  const ScanSnapshot& snapshot = *collected;
  if (!has_snapshot_) {
    has_snapshot_ = true;
    if (controller_->hasSource()) rememberSource(controller_->source());
  }
  regions_->showSnapshot(snapshot);
  scene_->view()->showSnapshot(collected);
  guide_->showSnapshot(snapshot);
  frames_->showSnapshot(snapshot);
  status_->showSnapshot(snapshot);
  progress_->showSnapshot(snapshot);
  time_line_->showSnapshot(snapshot);
  model_.setInView(snapshot.objects);
}

void MainWindow::showState(ScanState state) {
  if (state == ScanState::starting) {
    // Nothing of the scan before may remain, whatever came after its end was asked for.
    scene_->view()->clearScene();
    frames_->clear();
  }
  const bool is_over = state == ScanState::finished || state == ScanState::failed;
  status_->showState(onStartPage() && is_over ? ScanState::idle : state);
  progress_->showState(state);
  scene_->view()->setScanning(state == ScanState::scanning);
  actions_->enableFor(state, controller_->hasSource());
}

void MainWindow::scanFailed(const ScanFailed& event) {
  messages_->show(MessageBar::Kind::error, QString::fromStdString(event.error.message()));
  if (!has_snapshot_) showStartPage();
}

void MainWindow::chooseTheme(ThemeChoice choice) {
  Theme::instance().choose(choice);
  QSettings().setValue(QStringLiteral("theme"), static_cast<int>(choice));
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!objects_->list()->finishEditing()) {
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
