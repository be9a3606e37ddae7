#include "ui/main_window/scan_controller.h"

namespace scantrove {

ScanController::ScanController(const SessionFactory& factory, const WindowOptions& options, QObject* parent)
    : QObject(parent), bridge_(factory) {
  request_.device = options.device;
  request_.params = options.params;
  request_.start_paused = options.start_paused;
}

void ScanController::open(const QString& source, const SourceOptions& options, ScanRequest::Poses poses) {
  source_ = source;
  request_.source = source.toStdString();
  request_.source_options = options;
  request_.poses = poses;
  paused_ = request_.start_paused;
  emit opening(source_);
  bridge_.start(request_);
}

void ScanController::start() {
  if (bridge_.state() == ScanState::paused) {
    setPaused(false);
  } else if (hasSource()) {
    paused_ = request_.start_paused;
    emit opening(source_);
    bridge_.start(request_);
  }
}

bool ScanController::isUnderWay() const {
  return bridge_.state() == ScanState::scanning || bridge_.state() == ScanState::paused;
}

void ScanController::setPaused(bool paused) {
  if (paused == paused_) return;
  paused_ = paused;
  paused ? bridge_.pause() : bridge_.resume();
}

void ScanController::togglePause() {
  if (isUnderWay()) setPaused(!paused_);
}

void ScanController::step() {
  if (!isUnderWay()) return;
  setPaused(true);
  bridge_.step();
}

void ScanController::stop() {
  if (bridge_.busy()) bridge_.stop();
}

void ScanController::setParams(const ScanParams& params) {
  request_.params = params;
  bridge_.setParams(params);
}

}  // namespace scantrove
