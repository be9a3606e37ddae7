#include "ui/main_window/scan_display.h"

#include "ui/main_window/coverage_guide.h"
#include "ui/main_window/main_actions.h"
#include "ui/main_window/main_window.h"
#include "ui/main_window/project_choice.h"
#include "ui/main_window/recent_sources.h"
#include "ui/main_window/region_controller.h"
#include "ui/main_window/scan_controller.h"
#include "ui/main_window/scene_pane.h"
#include "ui/panels/frame_panels.h"
#include "ui/panels/message_bar.h"
#include "ui/panels/params_panel.h"
#include "ui/panels/progress_strip.h"
#include "ui/panels/start_page.h"
#include "ui/panels/status_strip.h"
#include "ui/panels/time_line.h"

namespace scantrove {

ScanDisplay::ScanDisplay(MainWindow& window) : QObject(&window), window_(window), parts_(window.parts()) {
  ScanBridge& bridge = window_.controller().bridge();
  connect(&window_.controller(), &ScanController::opening, this, &ScanDisplay::begin);
  connect(&bridge, &ScanBridge::snapshotArrived, this,
          [this](const std::shared_ptr<const ScanSnapshot>& snapshot) { showSnapshot(snapshot); });
  bridge.on<StateChanged>(this, [this](StateChanged changed) { showState(changed.state); });
  bridge.on<RefinementStepped>(this, [this](const RefinementStepped& progress) {
    parts_.status->showRefinement(progress.keyFrame(), progress.key_frames);
    parts_.progress->showRefinement(progress);
  });
  bridge.on<PreparingDevice>(this, [this] { parts_.status->showPreparing(); });
  bridge.on<ScanFailed>(this, [this](const ScanFailed& event) { scanFailed(event); });
  const auto warn = [this](const auto& event) {
    parts_.messages->show(MessageBar::Kind::warning, QString::fromStdString(event.error.message()));
  };
  bridge.on<FrameSkipped>(this, warn);
  bridge.on<CatalogueFailed>(this, warn);
  bridge.on<MapFailed>(this, warn);
  bridge.on<MapDrifted>(this, warn);
  bridge.on<CameraLost>(this, warn);
  bridge.on<CameraReturned>(this, [this](const CameraReturned& returned) {
    parts_.messages->dismiss();
    parts_.messages->show(MessageBar::Kind::info, QString::fromStdString(returned.error.message()));
  });
  bridge.on<ScanAdvice>(this, [this](const ScanAdvice& advice) { showAdvice(advice); });
  bridge.on<ObjectAdded>(this, [this](const ObjectAdded& added) { window_.model().markAdded(added.object); });
  bridge.on<ObjectRecognized>(
      this, [this](const ObjectRecognized& known) { window_.model().markRecognized(known.object); });
  bridge.on<ReviewOpened>(this, [this](ReviewOpened opened) {
    if (window_.onStartPage()) return;  // the scan was closed meanwhile
    parts_.actions->enableReview(true);
    parts_.actions->enableRefinement(opened.can_refine);
    parts_.actions->continue_scan->setEnabled(!window_.controller().sessionFolder().isEmpty());
    has_snapshot_ = true;
  });
}

void ScanDisplay::begin(const QString& source) {
  parts_.params->finishTyping();
  const bool is_saved_scan = !window_.controller().hasSource() || window_.controller().isContinued();
  is_saved_scan ? window_.project().showCatalogueOf(window_.controller().sessionFolder())
                : window_.project().showChosen();
  window_.showTitle(sourceTitle(source));
  parts_.progress->begin(sourceTitle(source));
  parts_.scene->view()->clearScene();
  parts_.frames->clear();
  window_.regions().beginScan();
  window_.guide().beginScan(window_.controller().request().object.has_value());
  parts_.time_line->clear();
  parts_.actions->enableReview(false);
  parts_.actions->enableRefinement(false);
  window_.model().beginScan();
  has_snapshot_ = false;
  window_.showScene();
}

void ScanDisplay::showSnapshot(const std::shared_ptr<const ScanSnapshot>& collected) {
  if (window_.onStartPage()) return;  // of a scan that was closed
  const ScanSnapshot& snapshot = *collected;
  if (!has_snapshot_) {
    has_snapshot_ = true;
    parts_.scene->view()->scene().setVoxelSize(snapshot.voxel_size_m);
    if (window_.controller().hasSource()) addRecentSource(window_.controller().source());
  }
  window_.regions().showSnapshot(snapshot);
  parts_.scene->view()->showSnapshot(collected);
  window_.guide().showSnapshot(snapshot);
  parts_.frames->showSnapshot(snapshot);
  parts_.status->showSnapshot(snapshot);
  parts_.progress->showSnapshot(snapshot);
  parts_.time_line->showSnapshot(snapshot);
  window_.model().setInView(snapshot.objects);
}

void ScanDisplay::showState(ScanState state) {
  if (state == ScanState::starting) {
    // Clears snapshots of the previous scan that arrived after the stop request.
    parts_.scene->view()->clearScene();
    parts_.frames->clear();
  }
  const bool is_over = state == ScanState::finished || state == ScanState::failed;
  parts_.status->showState(window_.onStartPage() && is_over ? ScanState::idle : state);
  parts_.progress->showState(state);
  parts_.scene->view()->drawing().setScanning(state == ScanState::scanning);
  parts_.actions->enableFor(state, window_.controller().hasSource());
}

void ScanDisplay::showAdvice(const ScanAdvice& advice) {
  if (!advice.proposed_units_per_meter)
    return parts_.messages->show(MessageBar::Kind::warning, QString::fromStdString(advice.error.message()));
  const double units_per_meter = *advice.proposed_units_per_meter;
  parts_.messages->show(MessageBar::Kind::warning, QString::fromStdString(advice.error.message()),
                        tr("Use %1 units per metre").arg(units_per_meter), [this, units_per_meter] {
                          window_.controller().reopenWithDepthScale(units_per_meter);
                        });
}

void ScanDisplay::scanFailed(const ScanFailed& event) {
  parts_.messages->show(MessageBar::Kind::error, QString::fromStdString(event.error.message()));
  if (!has_snapshot_) window_.showStartPage();
}

}  // namespace scantrove
