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

/// Overlay of the 3D view, transparent to the mouse: highlighted regions, names, the tag beside the pointer,
/// the current band or stroke, marks, and a hint at the top.
class SceneOverlay : public QWidget {
  Q_OBJECT

 public:
  explicit SceneOverlay(QWidget* parent);

  void setHighlight(const QImage& highlight);
  [[nodiscard]] const QImage& highlight() const { return highlight_; }
  /// `pointer` is none if it is not in the view.
  void setTag(const std::optional<QPointF>& pointer, const QStringList& tag);
  [[nodiscard]] const QStringList& tag() const { return tag_; }
  void setBand(const QRectF& band);
  /// In widget coordinates; empty: no stroke.
  void setStroke(const QPolygonF& points, const QColor& color);
  [[nodiscard]] const QPolygonF& stroke() const { return stroke_.points; }
  /// Marked points in one colour, in widget coordinates.
  struct Marks {
    QColor color;
    QPolygonF points;
  };
  void setMarks(std::vector<Marks> marks);
  [[nodiscard]] const std::vector<Marks>& marks() const { return marks_; }
  void setHint(const QString& hint);
  [[nodiscard]] const QString& hint() const { return hint_; }
  /// Ring of the selection in the lower left corner, with `words`; none: no ring.
  void setSeenSides(const std::optional<SeenSides>& seen, const QString& words);
  /// The name of a region, at a point of it in widget coordinates.
  struct Name {
    QPointF at;
    QString name;
    bool is_selected = false;
    bool operator==(const Name&) const = default;
  };
  /// Shows the names without overlap; the first have priority.
  void setNames(std::vector<Name> names);
  [[nodiscard]] const std::vector<Name>& names() const { return names_; }
  /// A text at a position of the view; none: no text.
  void setMark(const std::optional<QPointF>& at, const QString& word);
  [[nodiscard]] const std::optional<QPointF>& mark() const { return mark_; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paintSeenSides(QPainter& painter) const;
  void paintNames(QPainter& painter) const;

  QImage highlight_;
  std::optional<QPointF> pointer_;
  QStringList tag_;
  QRectF band_;
  Marks stroke_;
  std::vector<Marks> marks_;
  QString hint_;
  std::vector<Name> names_;
  std::optional<SeenSides> seen_sides_;
  QString sides_in_words_;
  std::optional<QPointF> mark_;
  QString mark_word_;
};

}  // namespace scantrove
