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

/// One picture of the current frame, scaled to fit, with its title in a corner. Reports pointing, clicks and
/// drags in fractions of the picture's width and height.
class ImagePanel : public QWidget {
  Q_OBJECT

 public:
  ImagePanel(const QString& title, const QString& explanation, QWidget* parent = nullptr);

  void setPicture(const QImage& picture);
  /// A sentence shown below the title while there is no picture; empty: none.
  void setEmptyText(const QString& text);
  [[nodiscard]] const QString& emptyText() const { return empty_text_; }
  /// Sets the tooltip: a click on the title enlarges this picture or, if it is large, the colour image.
  void setLarge(bool large);
  /// Drawn over the picture for highlighted regions; null: none.
  void setHighlight(const QImage& highlight);
  [[nodiscard]] const QImage& highlight() const { return highlight_; }
  /// Text shown beside the pointer while it is in this panel.
  void setTag(const QStringList& tag);
  [[nodiscard]] const QStringList& tag() const { return tag_; }
  /// With a colour, a drag on the picture draws a stroke; without, a selection band. Cancels the current
  /// stroke.
  void setStrokeColor(const std::optional<QColor>& color);
  /// The current stroke in widget coordinates; empty: none.
  [[nodiscard]] const QPolygonF& stroke() const { return stroke_.points(); }
  /// Marked points in one colour, in fractions of the picture.
  struct Marks {
    QColor color;
    QPolygonF fractions;
  };
  void setMarks(std::vector<Marks> marks);
  [[nodiscard]] const std::vector<Marks>& marks() const { return marks_; }
  [[nodiscard]] const QImage& picture() const { return picture_; }
  [[nodiscard]] const QString& title() const { return title_; }
  /// Rectangle of the picture in widget coordinates; empty if there is none.
  [[nodiscard]] QRectF pictureRect() const;
  /// Rectangle of the title in widget coordinates.
  [[nodiscard]] QRectF titleRect() const;
  /// Widget coordinates of a position in the picture.
  [[nodiscard]] QPointF positionOf(const QPointF& fraction) const;

 signals:
  void activated();  ///< the title was clicked, to enlarge the picture
  void opened();     ///< the title was clicked twice, to show the picture in the main area
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
  /// None if outside of the picture.
  [[nodiscard]] std::optional<QPointF> fractionAt(const QPointF& place) const;
  [[nodiscard]] QRectF band() const;

  QString title_, empty_text_;
  QImage picture_, highlight_;
  QStringList tag_;
  std::optional<QPointF> pointer_, pressed_;  ///< widget coordinates
  bool is_band_ = false;
  std::optional<QColor> stroke_color_;
  StrokePath stroke_;
  bool is_cancelled_ = false;  ///< the stroke was cancelled; the rest of the drag does nothing
  std::vector<Marks> marks_;
  bool is_double_click_ = false;
};

/// Text on a dark translucent chip, readable on any picture.
void paintChip(QPainter& painter, const QPointF& top_left, const QString& text, const QColor& text_color);

/// Size of the chip with that text in the painter's font.
[[nodiscard]] QSizeF chipSize(const QPainter& painter, const QString& text);

}  // namespace scantrove
