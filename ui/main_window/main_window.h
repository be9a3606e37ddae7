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

class CoverageGuide;
class DockArrangement;
class Presentation;
class ProjectChoice;
class RegionController;
class ScanController;
class WindowDialogs;

/// The main window: owns its parts and connects them with each other and the catalogue. ScanDisplay shows the
/// scan; MainMenus has the actions.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  MainWindow(const ScanPortFactory& factory, const WindowOptions& options);
  ~MainWindow() override;

  void open(const QString& source);
  /// Opens a project after closing the scan. Like the next two, does nothing while a typed name cannot be
  /// stored.
  void openProjectFolder(const QString& folder);
  void createProjectFolder(const QString& folder);
  /// Opens the project of a catalogue.
  void openCatalogue(const QString& file);

  /// Opens a saved scan.
  void openSession(const QString& folder);

  /// Ends or closes the scan and shows the start page.
  void closeScan();

  /// The title: `scan` (empty: none), the project unless it is the default one, and the program.
  void showTitle(const QString& scan);
  void showStartPage();
  void showScene();
  [[nodiscard]] bool onStartPage() const;

  [[nodiscard]] const WindowParts& parts() const { return parts_; }
  [[nodiscard]] ScanController& controller() { return *controller_; }
  [[nodiscard]] RegionController& regions() { return *regions_; }
  [[nodiscard]] ProjectChoice& project() { return *project_; }
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
  void showProject();
  [[nodiscard]] bool leavesScan();
  void readCatalogueChanges();

  UndoHistory history_;  ///< of all parts of the window; declared first to outlive them
  CatalogueEditor editor_;
  ObjectListModel model_;
  ScanController* controller_;
  ProjectChoice* project_;
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
