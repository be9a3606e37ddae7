#pragma once
#include <QColor>
#include <QImage>
#include <QPolygonF>
#include <QStringList>
#include <QWidget>
#include <optional>
#include <vector>

#include "core/geometry/view_coverage.h"

namespace scantrove {

/// Lies over the 3D view and lets the mouse through: what is lit up, the tag beside the pointer, the band or
/// stroke that is being drawn, what was drawn before, and a hint at the top.
class SceneOverlay : public QWidget {
  Q_OBJECT

 public:
  explicit SceneOverlay(QWidget* parent);

  void setLit(const QImage& lit);
  [[nodiscard]] const QImage& lit() const { return lit_; }
  /// None: the pointer is not in the view.
  void setTag(const std::optional<QPointF>& pointer, const QStringList& tag);
  [[nodiscard]] const QStringList& tag() const { return tag_; }
  void setBand(const QRectF& band);
  /// Widget coordinates; no places: none.
  void setStroke(const QPolygonF& places, const QColor& color);
  [[nodiscard]] const QPolygonF& stroke() const { return stroke_.places; }
  /// Places, widget coordinates, in one colour each.
  struct Marks {
    QColor color;
    QPolygonF places;
  };
  void setMarks(std::vector<Marks> marks);
  [[nodiscard]] const std::vector<Marks>& marks() const { return marks_; }
  void setHint(const QString& hint);
  [[nodiscard]] const QString& hint() const { return hint_; }
  /// Of what is selected, in the lower left corner, with `words`; none: nothing is.
  void setSeenSides(const std::optional<SeenSides>& seen, const QString& words);
  /// A word at a place of the scene; none: no place, or not in the picture.
  void setMark(const std::optional<QPointF>& place, const QString& word);
  [[nodiscard]] const std::optional<QPointF>& mark() const { return mark_; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paintSeenSides(QPainter& painter) const;

  QImage lit_;
  std::optional<QPointF> pointer_;
  QStringList tag_;
  QRectF band_;
  Marks stroke_;
  std::vector<Marks> marks_;
  QString hint_;
  std::optional<SeenSides> seen_sides_;
  QString sides_in_words_;
  std::optional<QPointF> mark_;
  QString mark_word_;
};

}  // namespace scantrove
