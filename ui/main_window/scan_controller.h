#pragma once
#include <QObject>
#include <QString>

#include "core/project/project.h"
#include "ui/bridge/scan_bridge.h"
#include "ui/main_window/scan_folder.h"
#include "ui/main_window/window_options.h"

namespace scantrove {

/// Runs the window's scan commands: holds the current source and settings, and sends commands to the worker.
class ScanController : public QObject {
  Q_OBJECT

 public:
  ScanController(const ScanPortFactory& factory, const WindowOptions& options, QObject* parent = nullptr);

  [[nodiscard]] ScanBridge& bridge() { return bridge_; }
  [[nodiscard]] const QString& source() const { return source_; }
  [[nodiscard]] bool hasSource() const { return !source_.isEmpty(); }
  [[nodiscard]] const ScanRequest& request() const { return request_; }

  /// Opens a source and starts scanning; a folder with a saved scan is opened by openSession().
  /// `object`: it is scanned alone; none: everything is scanned.
  void open(const QString& source, const SourceOptions& options = {},
            ScanRequest::Poses poses = ScanRequest::Poses::automatic,
            const std::optional<ObjectChoice>& object = std::nullopt);
  /// Scans the current source anew with another depth scale, and as before otherwise.
  void reopenWithDepthScale(double units_per_meter);
  /// Opens the session of an earlier scan for review and edits.
  void openSession(const QString& folder);
  /// Does the missing refinement of the open session, or of another one.
  void refine();
  void refineSession(const QString& folder);
  /// Adds frames of a source to a saved scan, with its parameters and its catalogue.
  void continueSession(const QString& folder, const QString& source, const SourceOptions& options,
                       ScanRequest::Poses poses);
  /// Whether the current scan continues a saved one.
  [[nodiscard]] bool isContinued() const { return is_continued_; }
  /// Folder of the current session; empty: the scan is not saved.
  [[nodiscard]] QString sessionFolder() const;
  /// Whether new scans are saved as sessions; the default is true.
  void setSavesScans(bool saves) { saves_scans_ = saves; }
  /// Folder of the sessions of the project.
  [[nodiscard]] QString scansFolder() const;

  /// Scans the current source from its beginning, or resumes.
  void start();
  void togglePause();
  void step();  ///< processes one frame, then pauses
  void stop();
  /// Ends the scan and closes its review.
  void close();
  void setParams(const ScanParams& params);
  /// New scans use its catalogue and its folder of scans.
  void setProject(const Project& project);
  /// New scans use this catalogue; their folder stays that of the project.
  void setCatalogue(const QString& file) { request_.database = file.toStdString(); }

 signals:
  void opening(const QString& source);
  void failed(const QString& message);

 private:
  [[nodiscard]] bool isRunning() const;
  void begin();
  void setPaused(bool paused);

  Project project_ = defaultProject();
  ScanRequest request_;
  QString source_;
  /// The last requested state. The worker may lag behind, but a second key press must still count.
  bool paused_ = false;
  bool saves_scans_ = true;
  bool is_continued_ = false;
  ScanFolder new_folder_;  ///< declared before the bridge, so that the scan has ended when it is destroyed
  ScanBridge bridge_;
};

}  // namespace scantrove
