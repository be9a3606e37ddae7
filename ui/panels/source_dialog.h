#pragma once
#include <QDialog>

#include "core/scan/scan_request.h"

class QCheckBox;
class QComboBox;
class QDialogButtonBox;
class QLineEdit;
class QSpinBox;

namespace scantrove {

/// Dialog for opening a recording with options: intrinsics, depth scale, range of frames, whether to use its
/// poses, and whether one object alone is scanned.
class SourceDialog : public QDialog {
  Q_OBJECT

 public:
  explicit SourceDialog(const QString& source, QWidget* parent = nullptr);

  /// Title and button for adding frames to a saved scan.
  void askToContinue(const QString& scan);
  [[nodiscard]] QString source() const;
  [[nodiscard]] SourceOptions options() const;
  [[nodiscard]] ScanRequest::Poses poses() const;
  /// None: everything is scanned.
  [[nodiscard]] std::optional<ObjectChoice> object() const;

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
  QCheckBox* object_;
  QDialogButtonBox* buttons_;
};

/// Parses "fx,fy,cx,cy"; none if the text has another format.
[[nodiscard]] std::optional<Intrinsics> parseIntrinsics(const QString& text);

}  // namespace scantrove
