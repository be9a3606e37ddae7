#pragma once
#include <QStringList>
#include <QWidget>
#include <array>
#include <string>
#include <vector>

#include "core/dataset/scan_split.h"

class QLabel;
class QListWidget;
class QRadioButton;
class QSpinBox;

namespace scantrove {

/// Which scans a data set is of: the open one, or chosen ones of its project with a split by scan.
class ExportScansPanel : public QWidget {
  Q_OBJECT

 public:
  explicit ExportScansPanel(QWidget* parent = nullptr);

  /// The scans of the project of the open scan; with fewer than two the panel is hidden.
  void setScans(const QStringList& names);
  [[nodiscard]] bool isProject() const;
  /// The names of the ticked scans.
  [[nodiscard]] std::vector<std::string> scans() const;
  /// The shares of the spin boxes; no split if all scans are for training.
  [[nodiscard]] ScanSplit split() const;
  /// Why the choice cannot be exported; empty: it can.
  [[nodiscard]] QString problem() const;

 signals:
  void changed();

 private:
  void showShares();

  QRadioButton* this_scan_;
  QRadioButton* project_;
  QListWidget* list_;
  QWidget* split_row_;
  std::array<QSpinBox*, 2> shares_;  // of validation and tests
  QSpinBox* seed_;
  QLabel* training_;
};

}  // namespace scantrove
