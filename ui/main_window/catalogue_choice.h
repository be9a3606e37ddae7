#pragma once
#include <QObject>
#include <QString>

namespace scantrove {

class CatalogueEditor;
class ScanController;

/// Chooses the catalogue of the window. The user's choice, which scans write to, is stored between runs. A
/// saved scan is shown with its own catalogue, because its object ids are only valid there.
class CatalogueChoice : public QObject {
  Q_OBJECT

 public:
  /// Both outlive this.
  CatalogueChoice(CatalogueEditor& editor, ScanController& controller, QObject* parent = nullptr);

  /// Opens `given` for this run; if empty, the last chosen catalogue or the user's default one.
  void openAtStart(const QString& given);
  /// Uses `file` (created if missing) for new scans. While a scan is shown, the list keeps showing that
  /// scan's catalogue.
  void choose(const QString& file, bool is_scan_shown);
  void showChosen();
  /// Shows the catalogue of a saved scan, or no objects if it is missing.
  void showCatalogueOf(const QString& session_folder);
  [[nodiscard]] const QString& chosen() const { return chosen_; }

 signals:
  void warned(const QString& message);
  void failed(const QString& message);

 private:
  /// False if it cannot be opened; failed() was emitted.
  bool show(const QString& file);
  void use(const QString& file);

  CatalogueEditor& editor_;
  ScanController& controller_;
  QString chosen_;
};

}  // namespace scantrove
