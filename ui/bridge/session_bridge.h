#pragma once
#include <QObject>
#include <QTimer>
#include <memory>
#include <mutex>
#include <vector>

#include "ui/bridge/session_port.h"

namespace scantrove {

/// Carries a scan session's news from its thread to the window's. Events wait in a queue and none is lost; of
/// the snapshots only the newest is collected, about 15 times a second. What is delivered is in order: a
/// snapshot comes after all events that happened before it, and no snapshot of an earlier scan comes after
/// `starting`. All of it is for the window's thread.
class SessionBridge : public QObject {
  Q_OBJECT

 public:
  explicit SessionBridge(const SessionFactory& factory, QObject* parent = nullptr);
  ~SessionBridge() override;

  void start(const ScanRequest& request);
  void pause() { session_->pause(); }
  void resume() { session_->resume(); }
  void step() { session_->step(); }
  void stop() { session_->stop(); }
  void close() { session_->close(); }
  void skipRefinement() { session_->skipRefinement(); }
  void edit(const ScanEdit& edit) { session_->edit(edit); }
  void showKeyFrame(int place) { session_->showKeyFrame(place); }
  void previewExport(const ExportOptions& options) { session_->previewExport(options); }
  void sampleExport(const ExportOptions& options, std::optional<int> place) {
    session_->sampleExport(options, place);
  }
  void exportDataset(const ExportOptions& options) { session_->exportDataset(options); }
  void cancelExport() { session_->cancelExport(); }
  void catalogueChanged() { session_->catalogueChanged(); }
  void setParams(const ScanParams& params) { session_->setParams(params); }

  /// The last state that was delivered, not the one the worker may be in by now.
  [[nodiscard]] ScanState state() const { return state_; }
  /// A scan runs or is about to: it can be stopped.
  [[nodiscard]] bool busy() const;

 signals:
  void snapshotArrived(const std::shared_ptr<const scantrove::ScanSnapshot>& snapshot);
  void stateChanged(scantrove::ScanState state);
  void refinementStepped(const scantrove::RefinementStepped& progress);
  void preparingDevice();  ///< kernels are compiled: the first frame takes long
  void objectAdded(scantrove::ObjectId object, const QString& name);
  void objectRecognized(scantrove::ObjectId object, const QString& name);
  void viewAdded(scantrove::ObjectId object);
  void objectsMerged(scantrove::ObjectId into);
  void objectNamed(scantrove::ObjectId object);  ///< by a person who named a region
  /// The catalogue cannot be read or written for now; the scan goes on.
  void catalogueFailed(const QString& message);
  /// A part of the map cannot be written to disk for now, or not be read back; the scan goes on.
  void mapFailed(const QString& message);
  void mapDrifted(const QString& message);
  void scanAdvised(const QString& message);
  /// What a person wanted to do to the regions is done, and kept; `regions`: what it was about is now.
  void edited(const scantrove::ScanEdit& edit, const std::vector<scantrove::RegionId>& regions);
  /// It was not done, or is not kept.
  void editFailed(const scantrove::ScanEdit& edit, const QString& message);
  /// The session of the scan that has ended, or that was opened, can be worked with.
  void reviewOpened(bool can_refine);
  void exportPreviewed(const scantrove::ExportPreview& preview);
  void exportSampled(const scantrove::ExportSample& sample);
  void exportStepped(const scantrove::ExportProgress& progress);
  void exportFinished(const scantrove::ExportSummary& summary);
  void exportFailed(const QString& message);
  void frameSkipped(int frame_index, const QString& message);
  void scanFailed(const QString& message);
  void scanFinished(const scantrove::ScanReport& report);

 private:
  void receive(const ScanEvent& event);  ///< on the session's thread
  void deliver();
  void announce(const ScanEvent& event);

  std::mutex mutex_;
  std::vector<ScanEvent> queue_;  ///< guarded by mutex_
  ScanState state_ = ScanState::idle;
  QTimer timer_;
  std::unique_ptr<SessionPort> session_;  ///< last: its thread ends before the rest goes
};

}  // namespace scantrove
