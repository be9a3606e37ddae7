#pragma once
#include <QFrame>

#include "ui/models/typed_name.h"

class QPushButton;

namespace scantrove {

/// Two answers for a name that another object has already: another thing (the default), or the same one.
/// Shown below the field with the name, where Return gives the default, Shift+Return the other, and Tab moves
/// into it. In it the arrow keys change between the answers, and Return gives one.
class SameNameChoice : public QFrame {
  Q_OBJECT

 public:
  explicit SameNameChoice(QWidget* parent = nullptr);

  /// Shows the answers while the name is taken, else nothing.
  void ask(const TypedName& typed);
  void dismiss() { hide(); }
  [[nodiscard]] bool isAsking() const { return !isHidden(); }
  /// Moves the focus to the default answer.
  void enter();
  [[nodiscard]] bool holdsFocus() const;
  [[nodiscard]] QPushButton* button(TypedName::Answer answer) const {
    return answer == TypedName::Answer::another ? another_ : same_;
  }

 signals:
  void answered(scantrove::TypedName::Answer answer);
  void cancelled();
  /// The focus has left it, but not to another window or a popup.
  void left();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QPushButton* another_;
  QPushButton* same_;
};

}  // namespace scantrove
