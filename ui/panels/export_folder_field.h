#pragma once
#include <QWidget>

class QLineEdit;

namespace scantrove {

/// The folder of a data set: a proposed one until the user types another, which then stays.
class ExportFolderField : public QWidget {
  Q_OBJECT

 public:
  /// `name`: of the scan or project.
  explicit ExportFolderField(const QString& name, QWidget* parent = nullptr);

  [[nodiscard]] QString folder() const;
  /// Proposes a new folder for data sets of this format, unless the user typed one.
  void setFormat(const QString& format);
  /// The name of what is exported; proposes a folder as setFormat().
  void setName(const QString& name);

 private:
  void choose();
  void propose();

  QString name_, format_;
  QLineEdit* field_;
  bool is_typed_ = false;
};

}  // namespace scantrove
