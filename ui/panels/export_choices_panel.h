#pragma once
#include <QWidget>
#include <string>
#include <vector>

#include "core/dataset/dataset_export.h"

class QCheckBox;
class QComboBox;
class QLineEdit;
class QListWidget;
class QSpinBox;

namespace scantrove {

/// What a data set takes of its scans: frames, labels, classes, unlabelled objects, and the licence.
class ExportChoicesPanel : public QWidget {
  Q_OBJECT

 public:
  explicit ExportChoicesPanel(QWidget* parent = nullptr);

  /// Writes the choices into `options`.
  void apply(ExportOptions& options) const;
  /// Shows what the format has. `is_project`: its scans are split, not the frames of one scan.
  void showFor(DatasetFormat format, bool is_project);
  /// Offers these classes; ticks of the same names stay.
  void setClasses(const std::vector<std::string>& classes);
  void saveLicense() const;

 signals:
  void changed();

 private:
  [[nodiscard]] std::vector<std::string> chosenClasses() const;

  QCheckBox* all_frames_;
  QCheckBox* background_;
  QCheckBox* include_unfit_;
  QCheckBox* checked_only_;
  QCheckBox* textures_;
  QComboBox* labels_;
  QComboBox* unlabeled_;
  QListWidget* classes_;
  QSpinBox* validation_;
  QLineEdit* license_;
};

}  // namespace scantrove
