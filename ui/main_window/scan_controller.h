#pragma once
#include <QObject>
#include <QString>

#include "ui/bridge/scan_bridge.h"
#include "ui/main_window/scan_folder.h"
#include "ui/main_window/window_options.h"

namespace scantrove {

/// What the window's scan commands do: keeps what is open and with which settings, and commands the worker.
class ScanController : public QObject {
  Q_OBJECT

 public:
  ScanController(const ScanPortFactory& factory, const WindowOptions& options, QObject* parent = nullptr);

  [[nodiscard]] ScanBridge& bridge() { return bridge_; }
  [[nodiscard]] const QString& source() const { return source_; }
  [[nodiscard]] bool hasSource() const { return !source_.isEmpty(); }
  [[nodiscard]] const ScanRequest& request() const { return request_; }

  /// Opens a source and begins to scan it; a folder with a saved scan opens as openSession() does it.
  void open(const QString& source, const SourceOptions& options = {},
            ScanRequest::Poses poses = ScanRequest::Poses::tracked);
  /// Opens the session of an earlier scan to look at it and correct it.
  void openSession(const QString& folder);
  /// Does the refinement that the open session has not had.
  void refine();
  /// Where the session of the present scan is; empty: it is not kept.
  [[nodiscard]] QString sessionFolder() const;
  /// Whether scans that begin from now on become sessions; usually they do.
  void setKeepsScans(bool keeps) { keeps_scans_ = keeps; }
  /// Where sessions are kept.
  [[nodiscard]] static QString sessionsFolder();

  /// The present source again from its beginning, or on when paused.
  void start();
  void togglePause();
  void step();  ///< one frame, and pause
  void stop();
  /// Ends what there is to look at, too.
  void close();
  void setParams(const ScanParams& params);
  void setDatabase(const QString& file) { request_.database = file.toStdString(); }

 signals:
  void opening(const QString& source);
  void failed(const QString& message);

 private:
  [[nodiscard]] bool isRunning() const;
  void begin();
  void setPaused(bool paused);

  ScanRequest request_;
  QString source_;
  /// What was asked for last; the worker may not have come to it yet, and a second press is not to be lost.
  bool paused_ = false;
  bool keeps_scans_ = true;
  ScanFolder made_folder_;  ///< before the bridge: the scan has ended when it goes
  ScanBridge bridge_;
};

}  // namespace scantrove
