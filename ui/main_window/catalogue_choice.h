#pragma once
#include <QObject>
#include <QString>

namespace scantrove {

class CatalogueEditor;
class ScanController;

/// Which catalogue the window shows. A person chooses the one that scans write into; the choice is remembered
/// between runs. A saved scan is shown with its own catalogue, as its object numbers mean nothing elsewhere.
class CatalogueChoice : public QObject {
  Q_OBJECT

 public:
  /// Both outlive this.
  CatalogueChoice(CatalogueEditor& editor, ScanController& controller, QObject* parent = nullptr);

  /// `given` holds for this run. Empty: the catalogue that was chosen last, or the person's own.
  void openAtStart(const QString& given);
  /// Scans that begin from now on use `file` (created where there is none). With a scan on screen the list
  /// shows it only when that is closed.
  void choose(const QString& file, bool is_scan_shown);
  void showChosen();
  /// Shows the catalogue of a saved scan; no objects where that is missing.
  void showCatalogueOf(const QString& session_folder);
  [[nodiscard]] const QString& chosen() const { return chosen_; }

 signals:
  void noted(const QString& message);
  void failed(const QString& message);

 private:
  /// False: it cannot be opened, which was announced.
  bool show(const QString& file);
  void use(const QString& file);

  CatalogueEditor& editor_;
  ScanController& controller_;
  QString chosen_;
};

}  // namespace scantrove
