#pragma once
#include <QMainWindow>
#include <QTimer>
#include <memory>
#include <vector>

#include "ui/bridge/scan_bridge.h"
#include "ui/main_window/window_options.h"
#include "ui/main_window/window_parts.h"
#include "ui/models/catalogue_editor.h"
#include "ui/models/object_list_model.h"

class QStackedWidget;

namespace scantrove {

class CatalogueChoice;
class CoverageGuide;
class DockArrangement;
class Presentation;
class RegionController;
class ScanController;
class WindowDialogs;

/// The window: holds its parts and ties them to the catalogue and each other. ScanDisplay shows the scan in
/// them, MainMenus what can be done.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  MainWindow(const ScanPortFactory& factory, const WindowOptions& options);
  ~MainWindow() override;

  void open(const QString& source);
  /// Not while a name is being typed that cannot be stored.
  void openCatalogue(const QString& file);

  /// Looks at a scan that was kept.
  void openSession(const QString& folder);

  /// Ends what is scanned or looked at, and shows the first page.
  void closeScan();

  void showStartPage();
  void showScene();
  [[nodiscard]] bool onStartPage() const;

  [[nodiscard]] const WindowParts& parts() const { return parts_; }
  [[nodiscard]] ScanController& controller() { return *controller_; }
  [[nodiscard]] RegionController& regions() { return *regions_; }
  [[nodiscard]] CatalogueChoice& catalogue() { return *catalogue_; }
  [[nodiscard]] CatalogueEditor& editor() { return editor_; }
  [[nodiscard]] ObjectListModel& model() { return model_; }
  [[nodiscard]] UndoHistory& history() { return history_; }
  [[nodiscard]] CoverageGuide& guide() { return *guide_; }
  [[nodiscard]] WindowDialogs& dialogs() { return *dialogs_; }
  [[nodiscard]] DockArrangement& docks() { return *docks_; }
  [[nodiscard]] Presentation* presentation() const { return presentation_; }

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void makeCenter();
  void makeDocks(const ScanParams& params);
  void connectCatalogue();
  void connectRegions();
  void showSavedScans();
  void readCatalogueChanges();

  UndoHistory history_;  ///< of all parts of the window; outlives them
  CatalogueEditor editor_;
  ObjectListModel model_;
  ScanController* controller_;
  CatalogueChoice* catalogue_;
  WindowDialogs* dialogs_;
  WindowParts parts_;
  QStackedWidget* center_ = nullptr;
  RegionController* regions_ = nullptr;
  CoverageGuide* guide_ = nullptr;
  Presentation* presentation_ = nullptr;
  DockArrangement* docks_ = nullptr;
  QTimer catalogue_timer_;
};

}  // namespace scantrove
