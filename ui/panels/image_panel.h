#pragma once
#include <QImage>
#include <QString>
#include <QStringList>
#include <QWidget>
#include <optional>

namespace scantrove {

/// One picture of the current frame, as large as its proportions allow, with its title in a corner. A person
/// points at what it shows; places are in fractions of the picture's width and height.
class ImagePanel : public QWidget {
  Q_OBJECT

 public:
  ImagePanel(const QString& title, const QString& explanation, QWidget* parent = nullptr);

  void setPicture(const QImage& picture);
  /// A click on the title makes it large; or another one, when it is.
  void setLarge(bool large);
  /// Laid over the picture: what is pointed at; null: nothing.
  void setLit(const QImage& lit);
  [[nodiscard]] const QImage& lit() const { return lit_; }
  /// Shown beside the pointer while that is in this panel.
  void setTag(const QStringList& tag);
  [[nodiscard]] const QStringList& tag() const { return tag_; }
  [[nodiscard]] const QImage& picture() const { return picture_; }
  [[nodiscard]] const QString& title() const { return title_; }
  /// Where the picture is drawn, in widget coordinates; empty when there is none.
  [[nodiscard]] QRectF pictureRect() const;
  /// Of the title, in widget coordinates.
  [[nodiscard]] QRectF titleRect() const;
  /// In widget coordinates.
  [[nodiscard]] QPointF placeOf(const QPointF& fraction) const;

 signals:
  void activated();  ///< the title was clicked: show it large
  void pointedAt(const QPointF& fraction);
  void pointerLeft();
  void clicked(const QPointF& fraction, Qt::KeyboardModifiers modifiers);
  void doubleClicked(const QPointF& fraction);
  void menuWanted(const QPointF& fraction, const QPoint& on_screen);
  void bandDrawn(const QRectF& fractions, Qt::KeyboardModifiers modifiers);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void leaveEvent(QEvent* event) override;

  /// Draws on top of the picture; `rect` as pictureRect().
  virtual void paintOverlay(QPainter& painter, const QRectF& rect);

 private:
  void paintTitle(QPainter& painter, const QRectF& card);
  void paintPointing(QPainter& painter);
  [[nodiscard]] QFont smallFont() const;
  /// None: outside of the picture.
  [[nodiscard]] std::optional<QPointF> fractionAt(const QPointF& place) const;
  [[nodiscard]] QRectF band() const;

  QString title_;
  QImage picture_, lit_;
  QStringList tag_;
  std::optional<QPointF> pointer_, pressed_;  ///< widget coordinates
  bool is_band_ = false;
  bool is_double_click_ = false;
};

/// Text on a dark translucent chip, readable on any picture.
void paintChip(QPainter& painter, const QPointF& top_left, const QString& text, const QColor& text_color);

/// Of the chip with that text in the painter's font.
[[nodiscard]] QSizeF chipSize(const QPainter& painter, const QString& text);

}  // namespace scantrove
