#pragma once
#include <QDialog>

namespace scantrove {

/// The keys and what the mouse does. Stays beside the window; blocks nothing.
class HelpDialog : public QDialog {
  Q_OBJECT

 public:
  explicit HelpDialog(QWidget* parent = nullptr);
};

}  // namespace scantrove
