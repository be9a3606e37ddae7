#pragma once
#include <QDialog>

namespace scantrove {

/// Lists keys and mouse actions. Not modal.
class HelpDialog : public QDialog {
  Q_OBJECT

 public:
  explicit HelpDialog(QWidget* parent = nullptr);
};

}  // namespace scantrove
