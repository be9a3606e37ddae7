#pragma once
#include <QLabel>

#include "ui/models/plain_text.h"

namespace scantrove {

/// One line of plain text that is elided if it does not fit, at the end or as setElideMode() says. The
/// tooltip then has the full text.
class ElidedLabel : public QLabel {
  Q_OBJECT

 public:
  explicit ElidedLabel(QWidget* parent = nullptr) : QLabel(parent) { setTextFormat(Qt::PlainText); }

  void setElideMode(Qt::TextElideMode mode) {
    mode_ = mode;
    elide();
  }

  /// `help` is the tooltip; if empty, an elided text has the full text as tooltip.
  void setFullText(const QString& text, const QString& help = {}) {
    full_text_ = text;
    help_ = help;
    updateGeometry();
    elide();
  }

  [[nodiscard]] const QString& fullText() const { return full_text_; }

  [[nodiscard]] QSize sizeHint() const override {
    return {fontMetrics().horizontalAdvance(full_text_) + kMargin_px, QLabel::sizeHint().height()};
  }
  [[nodiscard]] QSize minimumSizeHint() const override {
    return {fontMetrics().averageCharWidth() * kMinLetters, QLabel::minimumSizeHint().height()};
  }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    QLabel::resizeEvent(event);
    elide();
  }

 private:
  static constexpr int kMargin_px = 2;
  static constexpr int kMinLetters = 4;

  void elide() {
    const QString shown = fontMetrics().elidedText(full_text_, mode_, contentsRect().width());
    setText(shown);
    setToolTip(help_.isEmpty() && shown != full_text_ ? plainTip(full_text_) : help_);
  }

  Qt::TextElideMode mode_ = Qt::ElideRight;
  QString full_text_;
  QString help_;
};

}  // namespace scantrove
