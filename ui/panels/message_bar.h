#pragma once
#include <QFrame>
#include <QString>
#include <functional>

class QLabel;
class QPushButton;

namespace scantrove {

/// A message over the lower edge of the view; does not block the window. Hidden while there is none.
class MessageBar : public QFrame {
  Q_OBJECT

 public:
  enum class Kind { info, warning, error };

  explicit MessageBar(QWidget* parent = nullptr);

  /// Shows `text` and counts repetitions. Only an error replaces an error.
  void show(Kind kind, const QString& text);
  /// The same with a button that dismisses the message and calls `act`.
  void show(Kind kind, const QString& text, const QString& button_text, std::function<void()> act);
  void dismiss();
  [[nodiscard]] QString text() const { return text_; }

 private:
  void paintKind();
  /// Whether the message is shown: an error stays in place of anything less.
  bool showText(Kind kind, const QString& message);

  Kind kind_ = Kind::info;
  QString text_;
  int repeats_ = 0;
  QLabel* picture_;
  QLabel* label_;
  QPushButton* button_;
  std::function<void()> act_;
};

}  // namespace scantrove
