#pragma once
#include <QImage>
#include <QString>
#include <QWidget>

namespace scantrove {

/// One picture of the current frame, as large as its proportions allow, with its title in a corner.
class ImagePanel : public QWidget {
  Q_OBJECT

 public:
  ImagePanel(const QString& title, const QString& explanation, QWidget* parent = nullptr);

  void setPicture(const QImage& picture);
  /// What a click does, for the tooltip and the cursor; empty: nothing.
  void setClickMeaning(const QString& meaning);
  [[nodiscard]] bool hasClickMeaning() const { return has_click_meaning_; }
  [[nodiscard]] const QImage& picture() const { return picture_; }
  [[nodiscard]] const QString& title() const { return title_; }
  /// Where the picture is drawn, in widget coordinates; empty when there is none.
  [[nodiscard]] QRectF pictureRect() const;

 signals:
  void activated();  ///< clicked, or Return pressed: show it large

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

  /// Draws on top of the picture; `rect` as pictureRect().
  virtual void paintOverlay(QPainter& painter, const QRectF& rect);

 private:
  void paintTitle(QPainter& painter, const QRectF& card);

  QString title_;
  QImage picture_;
  bool has_click_meaning_ = false;
};

/// Text on a dark translucent chip, readable on any picture.
void paintChip(QPainter& painter, const QPointF& top_left, const QString& text, const QColor& text_color);

/// Of the chip with that text in the painter's font.
[[nodiscard]] QSizeF chipSize(const QPainter& painter, const QString& text);

}  // namespace scantrove
