#pragma once
#include <QDialog>

#include "core/scan/scan_request.h"

class QComboBox;
class QDialogButtonBox;
class QLineEdit;
class QSpinBox;

namespace scantrove {

/// Opening a recording with what it does not tell of itself: the camera's intrinsics, the unit of its depth,
/// which part of it, and whether its own poses are to be used.
class SourceDialog : public QDialog {
  Q_OBJECT

 public:
  explicit SourceDialog(const QString& source, QWidget* parent = nullptr);

  [[nodiscard]] QString source() const;
  [[nodiscard]] SourceOptions options() const;
  [[nodiscard]] ScanRequest::Poses poses() const;

 private:
  void browse();
  void validate();

  QLineEdit* source_;
  QLineEdit* intrinsics_;
  QLineEdit* depth_scale_;
  QSpinBox* start_;
  QSpinBox* stride_;
  QSpinBox* frames_;
  QComboBox* poses_;
  QDialogButtonBox* buttons_;
};

/// "fx,fy,cx,cy"; nothing when that is not what the text says.
[[nodiscard]] std::optional<Intrinsics> parseIntrinsics(const QString& text);

}  // namespace scantrove
