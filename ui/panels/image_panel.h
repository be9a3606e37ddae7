#pragma once
#include <QColor>
#include <QImage>
#include <QString>
#include <QStringList>
#include <QWidget>
#include <optional>
#include <vector>

#include "ui/models/stroke_path.h"

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
  /// With a colour, a drag that begins on the picture draws a stroke of it; without, a band. A stroke on its
  /// way is given up.
  void setStrokeColor(const std::optional<QColor>& color);
  /// What is being drawn, widget coordinates; empty: nothing is.
  [[nodiscard]] const QPolygonF& stroke() const { return stroke_.places(); }
  /// Places that were drawn before, in fractions of the picture, in one colour each.
  struct Marks {
    QColor color;
    QPolygonF fractions;
  };
  void setMarks(std::vector<Marks> marks);
  [[nodiscard]] const std::vector<Marks>& marks() const { return marks_; }
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
  void menuRequested(const QPointF& fraction, const QPoint& on_screen);
  void bandDrawn(const QRectF& fractions, Qt::KeyboardModifiers modifiers);
  void strokeAt(const QPointF& fraction);
  void strokeEnded(Qt::KeyboardModifiers modifiers);

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
  void drag();
  void drawStroke(const QPolygonF& places);
  void endStroke(const QMouseEvent& event);
  [[nodiscard]] QFont smallFont() const;
  /// None: outside of the picture.
  [[nodiscard]] std::optional<QPointF> fractionAt(const QPointF& place) const;
  [[nodiscard]] QRectF band() const;

  QString title_;
  QImage picture_, lit_;
  QStringList tag_;
  std::optional<QPointF> pointer_, pressed_;  ///< widget coordinates
  bool is_band_ = false;
  std::optional<QColor> stroke_color_;
  StrokePath stroke_;
  bool is_given_up_ = false;  ///< the stroke of this press: the rest of the drag does nothing
  std::vector<Marks> marks_;
  bool is_double_click_ = false;
};

/// Text on a dark translucent chip, readable on any picture.
void paintChip(QPainter& painter, const QPointF& top_left, const QString& text, const QColor& text_color);

/// Of the chip with that text in the painter's font.
[[nodiscard]] QSizeF chipSize(const QPainter& painter, const QString& text);

}  // namespace scantrove
