#include "ui/main_window/main_window.h"

#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QMimeData>
#include <QSettings>
#include <QStackedWidget>
#include <QStatusBar>
#include <QVBoxLayout>

#include "ui/main_window/dock_arrangement.h"
#include "ui/main_window/main_actions.h"
#include "ui/main_window/recent_sources.h"
#include "ui/main_window/scan_controller.h"
#include "ui/main_window/scene_pane.h"
#include "ui/panels/color_panel.h"
#include "ui/panels/frame_panels.h"
#include "ui/panels/message_bar.h"
#include "ui/panels/object_list_view.h"
#include "ui/panels/object_panel.h"
#include "ui/panels/params_panel.h"
#include "ui/panels/progress_strip.h"
#include "ui/panels/start_page.h"
#include "ui/panels/status_strip.h"
#include "ui/theme/icon.h"

namespace scantrove {
namespace {
const QString kGeometryKey = QStringLiteral("window/geometry");
constexpr int kObjectsWidth = 290;
constexpr int kFramesWidth = 480;
constexpr int kOtherPrograms_ms = 1000;  ///< what they write is seen after that
constexpr int kHeldList_ms = 50;
}  // namespace

MainWindow::MainWindow(const SessionFactory& factory, const WindowOptions& options)
    : model_(editor_),
      controller_(new ScanController(factory, options, this)),
      actions_(new MainActions(editor_.undoStack(), this)) {
  setWindowTitle(QStringLiteral("Scantrove"));
  setWindowIcon(icon(QStringLiteral("scantrove")));
  setAcceptDrops(true);
  makeCentre();
  makeDocks(options.params);
  makeMenus();
  makeToolBar();
  status_ = new StatusStrip;
  statusBar()->addWidget(status_, 1);
  statusBar()->setSizeGripEnabled(false);
  statusBar()->setContentsMargins(0, 0, 0, 0);
  connectActions();
  connectSession();

  resize(1480, 920);
  if (options.width > 0 && options.height > 0) {
    resize(options.width, options.height);
  } else {
    restoreGeometry(QSettings().value(kGeometryKey).toByteArray());
  }
  docks_->restore();
  showStartPage();
  connectCatalogue();
  openCatalogue(options.database.empty() ? defaultCatalogueFile() : QString::fromStdString(options.database));
}

MainWindow::~MainWindow() {
  // The scan ends, and with it all news, before the first widget goes.
  delete controller_;
}

void MainWindow::makeCentre() {
  auto* column = new QWidget;
  auto* layout = new QVBoxLayout(column);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  messages_ = new MessageBar(column);
  centre_ = new QStackedWidget;
  start_ = new StartPage;
  scene_ = new ScenePane;
  centre_->addWidget(start_);
  centre_->addWidget(scene_);
  layout->addWidget(messages_);
  layout->addWidget(centre_, 1);
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
  params_ = new ParamsPanel(params);
  docks_->add({tr("Objects"), "objectsDock", tr("Ctrl+1"), Qt::LeftDockWidgetArea, kObjectsWidth, false},
              objects_);
  docks_->add({tr("Settings"), "settingsDock", tr("Ctrl+3"), Qt::LeftDockWidgetArea, kObjectsWidth, true},
              params_);
  docks_->add({tr("Current frame"), "framesDock", tr("Ctrl+2"), Qt::RightDockWidgetArea, kFramesWidth, true},
              frames_);
}

bool MainWindow::onStartPage() const { return centre_->currentWidget() == start_; }

void MainWindow::showStartPage() {
  start_->setRecent(recentSources());
  centre_->setCurrentWidget(start_);
  docks_->setScanShown(false);
  progress_->clear();
}

void MainWindow::showScene() {
  if (!onStartPage()) return;
  centre_->setCurrentWidget(scene_);
  docks_->setScanShown(true);
}

void MainWindow::open(const QString& source) {
  messages_->dismiss();
  controller_->open(source);
}

void MainWindow::openCatalogue(const QString& file) {
  if (!objects_->list()->finishEditing()) return;
  if (const Result<void> done = editor_.open(file); !done) {
    messages_->show(MessageBar::Kind::error, QString::fromStdString(done.error().message()));
    return;
  }
  controller_->setDatabase(editor_.file());
  objects_->setToolTip(tr("Catalogue: %1").arg(editor_.file()));
}

void MainWindow::connectSession() {
  SessionBridge& bridge = controller_->bridge();
  connect(controller_, &ScanController::opening, this, &MainWindow::beginScan);
  connect(&bridge, &SessionBridge::snapshotArrived, this,
          [this](const std::shared_ptr<const ScanSnapshot>& snapshot) { showSnapshot(*snapshot); });
  connect(frames_->colorPanel(), &ColorPanel::candidateClicked, &bridge, &SessionBridge::addCandidate);
  connect(&bridge, &SessionBridge::stateChanged, this, &MainWindow::showState);
  connect(&bridge, &SessionBridge::preparingDevice, status_, &StatusStrip::showPreparing);
  connect(&bridge, &SessionBridge::scanFailed, this, &MainWindow::scanFailed);
  connect(&bridge, &SessionBridge::frameSkipped, this, [this](int /*frame_index*/, const QString& message) {
    messages_->show(MessageBar::Kind::warning, message);
  });
  const auto warn = [this](const QString& message) { messages_->show(MessageBar::Kind::warning, message); };
  connect(&bridge, &SessionBridge::catalogueFailed, this, warn);
  connect(&bridge, &SessionBridge::mapFailed, this, warn);
  connect(&bridge, &SessionBridge::objectAdded, this, [this](ObjectId object) { model_.markAdded(object); });
  connect(&bridge, &SessionBridge::objectRecognised, this,
          [this](ObjectId object) { model_.markRecognised(object); });
}

void MainWindow::connectCatalogue() {
  SessionBridge& bridge = controller_->bridge();
  catalogue_timer_.setSingleShot(true);
  connect(&catalogue_timer_, &QTimer::timeout, this, &MainWindow::followCatalogue);
  const auto soon = [this] { catalogue_timer_.start(0); };
  connect(&bridge, &SessionBridge::objectAdded, this, soon);
  connect(&bridge, &SessionBridge::viewAdded, this, soon);
  connect(&bridge, &SessionBridge::objectsMerged, this, soon);
  connect(&bridge, &SessionBridge::objectNamed, this, soon);
  connect(&bridge, &SessionBridge::stateChanged, this, soon);
  connect(&editor_, &CatalogueEditor::edited, &bridge, &SessionBridge::catalogueChanged);
  connect(&editor_, &CatalogueEditor::failed, this,
          [this](const QString& message) { messages_->show(MessageBar::Kind::error, message); });
  connect(&model_, &ObjectListModel::dataChanged, frames_->colorPanel(), qOverload<>(&QWidget::update));
  connect(objects_, &ObjectPanel::selectionChanged, this, [this](const std::vector<ObjectId>& objects) {
    frames_->setSelected({objects.begin(), objects.end()});
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
  setWindowTitle(tr("%1 — Scantrove").arg(sourceTitle(source)));
  progress_->begin(sourceTitle(source));
  scene_->view()->clearScene();
  scene_->view()->scene().setVoxelSize(controller_->request().params.fusion.voxel_size_m);
  frames_->clear();
  model_.beginScan();
  has_snapshot_ = false;
  showScene();
}

void MainWindow::showSnapshot(const ScanSnapshot& snapshot) {
  if (!has_snapshot_) {
    has_snapshot_ = true;
    rememberSource(controller_->source());
  }
  scene_->view()->showSnapshot(snapshot);
  frames_->showSnapshot(snapshot);
  status_->showSnapshot(snapshot);
  progress_->showSnapshot(snapshot);
  model_.setInView(snapshot.objects);
}

void MainWindow::showState(ScanState state) {
  if (state == ScanState::starting) {
    // Nothing of the scan before may remain, whatever came after its end was asked for.
    scene_->view()->clearScene();
    frames_->clear();
  }
  status_->showState(state);
  scene_->view()->setScanning(state == ScanState::scanning);
  actions_->enableFor(state, controller_->hasSource());
}

void MainWindow::scanFailed(const QString& message) {
  messages_->show(MessageBar::Kind::error, message);
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
  open(urls.first().toLocalFile());
}

}  // namespace scantrove
