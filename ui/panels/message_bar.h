#pragma once
#include <QFrame>
#include <QString>

class QLabel;

namespace scantrove {

/// A message at the top of the window; does not block it. Hidden while there is none.
class MessageBar : public QFrame {
  Q_OBJECT

 public:
  enum class Kind { info, warning, error };

  explicit MessageBar(QWidget* parent = nullptr);

  /// Shows `text` and counts repetitions. Only an error replaces an error.
  void show(Kind kind, const QString& text);
  void dismiss();
  [[nodiscard]] QString text() const { return text_; }

 private:
  void paintKind();

  Kind kind_ = Kind::info;
  QString text_;
  int repeats_ = 0;
  QLabel* picture_;
  QLabel* label_;
};

}  // namespace scantrove
