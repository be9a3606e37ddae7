#pragma once
#include <QDialog>
#include <functional>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/capture/cameras.h"
#include "core/scan/scan_request.h"

class QCheckBox;
class QLabel;
class QListWidget;
class QPushButton;

namespace scantrove {

/// Lists the depth cameras of this computer and the virtual one; gives advice if there is none.
class CameraDialog : public QDialog {
  Q_OBJECT

 public:
  using Lister = std::function<Result<std::vector<CameraInfo>>()>;

  explicit CameraDialog(Lister lister, QWidget* parent = nullptr);
  /// "camera:URI" of the chosen camera; empty: none is chosen yet.
  [[nodiscard]] QString source() const;
  /// None: everything is scanned.
  [[nodiscard]] std::optional<ObjectChoice> object() const;

 public slots:
  void refresh();

 private:
  Lister lister_;
  QListWidget* list_;
  QLabel* advice_;
  QCheckBox* object_;
  QPushButton* open_;
};

}  // namespace scantrove
