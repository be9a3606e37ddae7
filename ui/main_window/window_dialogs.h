#pragma once
#include <QObject>
#include <QString>

namespace scantrove {

class ClassDialog;
class ExportDialog;
class HelpDialog;
class MainWindow;

/// Opens the dialogs of the menus and applies their results.
class WindowDialogs : public QObject {
  Q_OBJECT

 public:
  explicit WindowDialogs(MainWindow& window);

  void openFolder();
  void openRecording();
  void openWithOptions();
  void openCamera();
  void openProject();
  void newProject();
  void chooseCatalogue();
  void connectCatalogue();
  void chooseSession();
  void showExport();
  void closeExport();
  void showClasses();
  void showHelp();
  void showAbout();

  /// Null: it was not open yet.
  [[nodiscard]] ClassDialog* classDialog() const { return classes_; }
  /// Null if it is not open.
  [[nodiscard]] ExportDialog* exportDialog() const { return export_; }

 private:
  /// Where the dialogs for projects begin.
  [[nodiscard]] QString projectsFolder() const;
  /// Tells the export dialog the project of the open scan, when its scans are read.
  void offerProject();

  MainWindow& window_;
  ExportDialog* export_ = nullptr;
  ClassDialog* classes_ = nullptr;
  HelpDialog* help_ = nullptr;
};

}  // namespace scantrove
