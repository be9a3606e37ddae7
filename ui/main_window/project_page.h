#pragma once
#include <QObject>
#include <QString>

#include "ui/panels/saved_scans_panel.h"

namespace scantrove {

class MainWindow;

/// The scans of the open project on the start page: reads their summaries on another thread, and does what a
/// user requests with one.
class ProjectPage : public QObject {
  Q_OBJECT

 public:
  /// Call after the window's parts were created.
  explicit ProjectPage(MainWindow& window);

  /// Reads the scans of the project again; they are shown when they are read.
  void refresh();
  /// Asks for the source, and adds its frames to the saved scan.
  void continueScan(const QString& folder);

 signals:
  void shown();  ///< the scans that were read

 private:
  void perform(const QString& folder, SavedScanAction action);
  void remove(const QString& folder);

  MainWindow& window_;
  int reading_ = 0;        ///< number of the newest reading
  QString exported_next_;  ///< a scan whose export opens with it; empty: none
};

}  // namespace scantrove
