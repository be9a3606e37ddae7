#pragma once
#include <QFrame>
#include <QString>

class QLabel;

namespace scantrove {

/// One message at the top of the window that waits to be read and blocks nothing. Hidden while there is none.
class MessageBar : public QFrame {
  Q_OBJECT

 public:
  enum class Kind { info, warning, error };

  explicit MessageBar(QWidget* parent = nullptr);

  /// Shows `text`; a repeated one is counted. An error is not replaced by anything milder.
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
