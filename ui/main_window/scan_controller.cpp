#include "ui/main_window/scan_controller.h"

#include <QDateTime>

#include "core/project/opened_path.h"
#include "ui/main_window/recent_sources.h"
#include "ui/panels/start_page.h"

namespace scantrove {
namespace {

/// The day and time in the name of a scan's folder, for example "2026-11-22 15.40.02".
std::string timeOfDay() {
  return QDateTime::currentDateTime().toString(QStringLiteral("yyyy-MM-dd HH.mm.ss")).toStdString();
}

}  // namespace

ScanController::ScanController(const ScanPortFactory& factory, const WindowOptions& options, QObject* parent)
    : QObject(parent), bridge_(factory) {
  request_.device = options.device;
  request_.params = options.params;
  request_.start_paused = options.start_paused;
  request_.results = false;
  request_.review = true;
  bridge_.on<ScanFailed>(this, [this] { new_folder_.removeIfEmpty(); });
}

QString ScanController::scansFolder() const {
  return QString::fromStdString(project_.scansFolder().string());
}

void ScanController::setProject(const Project& project) {
  project_ = project;
  request_.database = project.catalogue.string();
}

QString ScanController::sessionFolder() const {
  return request_.output_folder ? QString::fromStdString(request_.output_folder->string()) : QString();
}

void ScanController::begin() {
  is_continued_ = false;
  request_.source = source_.toStdString();
  request_.output_folder.reset();
  const std::string title = sourceTitle(source_).toStdString();
  const QString folder = QString::fromStdString(newScanFolder(project_, timeOfDay(), title).string());
  if (!saves_scans_) {
    // not saved on purpose, so no warning
  } else if (new_folder_.make(folder)) {
    request_.output_folder = folder.toStdString();
  } else {
    emit failed(
        tr("The scan is not saved, because %1 is not writable. Make it writable, or open another project.")
            .arg(scansFolder()));
  }
  paused_ = request_.start_paused;
  emit opening(source_);
  bridge_.post(StartScan{request_});
}

void ScanController::openSession(const QString& folder) {
  is_continued_ = false;
  source_.clear();
  request_.source.clear();
  request_.object.reset();
  request_.output_folder = folder.toStdString();
  emit opening(folder);
  bridge_.post(StartScan{request_});
}

void ScanController::refine() {
  if (!request_.output_folder) return;
  ScanRequest request = request_;
  request.refine_session = true;
  request.database.clear();  // uses that of the session
  emit opening(hasSource() ? source_ : sessionFolder());
  bridge_.post(StartScan{std::move(request)});
}

void ScanController::refineSession(const QString& folder) {
  is_continued_ = false;
  source_.clear();
  request_.source.clear();
  request_.object.reset();
  request_.output_folder = folder.toStdString();
  refine();
}

void ScanController::continueSession(const QString& folder, const QString& source,
                                     const SourceOptions& options, ScanRequest::Poses poses) {
  is_continued_ = true;
  source_ = source;
  request_.source = source.toStdString();
  request_.source_options = options;
  request_.poses = poses;
  request_.object.reset();
  request_.output_folder = folder.toStdString();
  ScanRequest request = request_;
  request.resume = true;
  request.database.clear();  // uses that of the session
  paused_ = request.start_paused;
  emit opening(source_);
  bridge_.post(StartScan{std::move(request)});
}

void ScanController::open(const QString& source, const SourceOptions& options, ScanRequest::Poses poses,
                          const std::optional<ObjectChoice>& object) {
  if (const OpenedPath path = recognizePath(source.toStdString()); path.kind == OpenedPath::Kind::scan)
    return openSession(QString::fromStdString(path.folder.string()));
  source_ = source;
  request_.source_options = options;
  request_.poses = poses;
  request_.object = object;
  begin();
}

void ScanController::reopenWithDepthScale(double units_per_meter) {
  if (!hasSource()) return;
  request_.source_options.depth_scale = units_per_meter;
  begin();
}

void ScanController::start() {
  if (bridge_.state() == ScanState::paused) {
    setPaused(false);
  } else if (hasSource()) {
    begin();
  }
}

bool ScanController::isRunning() const {
  return bridge_.state() == ScanState::scanning || bridge_.state() == ScanState::paused;
}

void ScanController::setPaused(bool paused) {
  if (paused == paused_) return;
  paused_ = paused;
  bridge_.post(paused ? ScanCommand(PauseScan{}) : ResumeScan{});
}

void ScanController::togglePause() {
  if (isRunning()) setPaused(!paused_);
}

void ScanController::step() {
  if (!isRunning()) return;
  setPaused(true);
  bridge_.post(StepScan{});
}

void ScanController::stop() {
  if (bridge_.busy()) bridge_.post(StopScan{});
}

void ScanController::close() {
  bridge_.post(CloseScan{});
  source_.clear();
}

void ScanController::setParams(const ScanParams& params) {
  request_.params = params;
  bridge_.post(SetParams{params});
}

}  // namespace scantrove
