#pragma once
#include <QMainWindow>
#include <QTimer>
#include <memory>
#include <vector>

#include "ui/bridge/scan_bridge.h"
#include "ui/main_window/window_options.h"
#include "ui/models/catalogue_editor.h"
#include "ui/models/object_list_model.h"
#include "ui/theme/theme.h"

class QStackedWidget;

namespace scantrove {

class CatalogueChoice;
class CoverageGuide;
class DockArrangement;
class ExportDialog;
class FramePanels;
class HelpDialog;
class MainActions;
class MessageBar;
class ObjectPanel;
class ParamsPanel;
class Presentation;
class ProgressStrip;
class RegionController;
class ScanController;
class ScenePane;
class StartPage;
class StatusStrip;
class TimeLine;

/// The window: holds the docks and menus and ties them to the scan, the catalogue and each other.
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

  [[nodiscard]] ScanController& controller() { return *controller_; }
  [[nodiscard]] RegionController& regions() { return *regions_; }
  [[nodiscard]] CoverageGuide& guide() { return *guide_; }
  [[nodiscard]] TimeLine* timeLine() const { return time_line_; }
  [[nodiscard]] ExportDialog* exportDialog() const { return export_; }
  [[nodiscard]] CatalogueEditor& editor() { return editor_; }
  [[nodiscard]] UndoHistory& history() { return history_; }
  [[nodiscard]] ObjectPanel* objectPanel() const { return objects_; }
  [[nodiscard]] FramePanels* framePanels() const { return frames_; }
  [[nodiscard]] ScenePane* scenePane() const { return scene_; }
  [[nodiscard]] MessageBar* messageBar() const { return messages_; }
  [[nodiscard]] ProgressStrip* progressStrip() const { return progress_; }
  [[nodiscard]] MainActions& actions() const { return *actions_; }
  [[nodiscard]] DockArrangement& docks() { return *docks_; }
  [[nodiscard]] Presentation* presentation() const { return presentation_; }
  [[nodiscard]] bool onStartPage() const;

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void makeCenter();
  void makeDocks(const ScanParams& params);
  void makeMenus();
  void makeToolBar();
  void connectActions();
  void connectSession();
  void connectCatalogue();
  void connectRegions();
  void fillRecentMenu();

  void openFolder();
  void openRecording();
  void openWithOptions();
  void openCamera();
  void chooseCatalogue();
  void chooseSession();
  void showExport();
  void showHelp();
  void showAbout();

  void beginScan(const QString& source);
  void showSnapshot(const std::shared_ptr<const ScanSnapshot>& collected);
  void showState(ScanState state);
  void scanFailed(const ScanFailed& event);
  void showStartPage();
  void showSavedScans();
  void showScene();
  void followCatalogue();
  void chooseTheme(ThemeChoice choice);

  UndoHistory history_;  ///< of all parts of the window; outlives them
  CatalogueEditor editor_;
  ObjectListModel model_;
  ScanController* controller_;
  CatalogueChoice* catalogue_;
  MainActions* actions_;
  QStackedWidget* center_ = nullptr;
  StartPage* start_ = nullptr;
  ScenePane* scene_ = nullptr;
  TimeLine* time_line_ = nullptr;
  RegionController* regions_ = nullptr;
  CoverageGuide* guide_ = nullptr;
  ExportDialog* export_ = nullptr;
  Presentation* presentation_ = nullptr;
  MessageBar* messages_ = nullptr;
  FramePanels* frames_ = nullptr;
  ObjectPanel* objects_ = nullptr;
  ParamsPanel* params_ = nullptr;
  ProgressStrip* progress_ = nullptr;
  StatusStrip* status_ = nullptr;
  HelpDialog* help_ = nullptr;
  QMenu* recent_ = nullptr;
  DockArrangement* docks_ = nullptr;
  QTimer catalogue_timer_;
  bool has_snapshot_ = false;  ///< of the present scan
};

}  // namespace scantrove
