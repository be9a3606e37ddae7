#pragma once
#include <QObject>
#include <QString>
#include <QStringList>
#include <string>

#include "core/project/project.h"

namespace scantrove {

class CatalogueEditor;
class ScanController;

/// Chooses the project of the window: new scans are saved in it and use its catalogue. The choice is stored
/// between runs. A saved scan is shown with its own catalogue, because its object ids are only valid there.
class ProjectChoice : public QObject {
  Q_OBJECT

 public:
  /// Both outlive this.
  ProjectChoice(CatalogueEditor& editor, ScanController& controller, QObject* parent = nullptr);

  /// Opens the given project, which is then the one chosen last; or the given catalogue for this run; if both
  /// are empty, the project chosen last, or the default one.
  void openAtStart(const QString& project, const QString& catalogue);
  /// Opens the project in `folder`. False: it cannot be opened, and the old one stays; failed() was emitted.
  bool open(const QString& folder);
  /// Creates a project in a new or an empty folder and opens it. False as open().
  bool create(const QString& folder);
  /// Uses the project of the catalogue `file`, which is created if missing. While a scan is shown, the list
  /// keeps showing that scan's catalogue.
  void chooseCatalogue(const QString& file, bool is_scan_shown);
  void showChosen();
  /// Shows the catalogue of a saved scan, or no objects if it is missing.
  void showCatalogueOf(const QString& session_folder);
  [[nodiscard]] const Project& project() const { return project_; }
  [[nodiscard]] QString name() const { return QString::fromStdString(project_.name); }
  /// The folder of the catalogue, or the address of its server.
  [[nodiscard]] QString place() const;
  /// The catalogue's file; that of the default project if the catalogue lies on a server.
  [[nodiscard]] std::string catalogueFile() const;
  /// Folders of projects and files of catalogues that exist, and addresses of servers, the newest first.
  [[nodiscard]] static QStringList recent();
  [[nodiscard]] static QStringList recentServers();
  /// What a menu shows for one of recent().
  [[nodiscard]] static QString titleOf(const QString& place);

 signals:
  void changed();  ///< another project
  void warned(const QString& message);
  void failed(const QString& message);

 private:
  /// False if it cannot be opened; failed() was emitted.
  bool show(const QString& file);
  bool showAndUse(const Project& project);
  void use(const Project& project);
  void remember() const;

  CatalogueEditor& editor_;
  ScanController& controller_;
  Project project_ = defaultProject();
  bool is_chosen_ = false;  // not before openAtStart()
};

}  // namespace scantrove
