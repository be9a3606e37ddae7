#include "ui/panels/scene_overlay.h"

#include <QPainter>
#include <utility>

#include "ui/panels/coverage_ring.h"
#include "ui/panels/image_panel.h"
#include "ui/panels/label_placement.h"
#include "ui/panels/region_picture.h"
#include "ui/theme/theme.h"

namespace scantrove {

SceneOverlay::SceneOverlay(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setAttribute(Qt::WA_NoSystemBackground);
  setFocusPolicy(Qt::NoFocus);
}

void SceneOverlay::setHighlight(const QImage& highlight) {
  if (highlight.isNull() && highlight_.isNull()) return;
  highlight_ = highlight;
  update();
}

void SceneOverlay::setTag(const std::optional<QPointF>& pointer, const QStringList& tag) {
  if (tag.isEmpty() && tag_.isEmpty()) return;
  pointer_ = pointer;
  tag_ = tag;
  update();
}

void SceneOverlay::setBand(const QRectF& band) {
  band_ = band;
  update();
}

void SceneOverlay::setStroke(const QPolygonF& points, const QColor& color) {
  if (points.isEmpty() && stroke_.points.isEmpty()) return;
  stroke_ = {color, points};
  update();
}

void SceneOverlay::setMarks(std::vector<Marks> marks) {
  if (marks.empty() && marks_.empty()) return;
  marks_ = std::move(marks);
  update();
}

void SceneOverlay::setHint(const QString& hint) {
  if (hint == hint_) return;
  hint_ = hint;
  update();
}

void SceneOverlay::setSeenSides(const std::optional<SeenSides>& seen, const QString& words) {
  if (seen == seen_sides_ && words == sides_in_words_) return;
  seen_sides_ = seen;
  sides_in_words_ = words;
  update();
}

void SceneOverlay::setMark(const std::optional<QPointF>& at, const QString& word) {
  if (at == mark_ && word == mark_word_) return;
  mark_ = at;
  mark_word_ = word;
  update();
}

void SceneOverlay::setNames(std::vector<Name> names) {
  if (names == names_) return;
  names_ = std::move(names);
  update();
}

void SceneOverlay::paintNames(QPainter& painter) const {
  constexpr double kWidest_px = 180;
  std::vector<QString> texts;
  std::vector<LabelRequest> requests;
  for (const Name& name : names_) {
    texts.push_back(QFontMetricsF(painter.font()).elidedText(name.name, Qt::ElideRight, kWidest_px));
    const QSizeF size = chipSize(painter, texts.back());
    // placeLabels() prefers the place above a box: then the label is centred at the point.
    requests.push_back(
        {{name.at.x() - size.width() / 2, name.at.y() + size.height() / 2, size.width(), 1}, size});
  }
  const std::vector<QRectF> places = placeLabels(requests, rect());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].isNull()) continue;
    paintChip(painter, places[i].topLeft(), texts[i],
              names_[i].is_selected ? QColor(0xff, 0xd0, 0x00) : QColor(Qt::white));
  }
}

void SceneOverlay::paintSeenSides(QPainter& painter) const {
  constexpr double kRing = 44;
  constexpr double kMargin = 14;
  const QRectF square(kMargin, height() - kMargin - kRing, kRing, kRing);
  paintCoverageRing(&painter, square, *seen_sides_, Theme::instance().colors());
  const double chip_height = chipSize(painter, sides_in_words_).height();
  paintChip(painter, {square.right() + 10, square.center().y() - chip_height / 2}, sides_in_words_,
            Qt::white);
}

void SceneOverlay::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  if (!highlight_.isNull()) painter.drawImage(QRectF(rect()), highlight_);
  paintNames(painter);
  if (!band_.isEmpty()) {
    painter.setPen(QPen(QColor(0xff, 0xd0, 0x00), 1, Qt::DashLine));
    painter.setBrush(QColor(0xff, 0xd0, 0x00, 40));
    painter.drawRect(band_);
  }
  for (const Marks& marks : marks_) paintMarks(painter, marks.points, marks.color);
  if (!stroke_.points.isEmpty()) paintStroke(painter, stroke_.points, stroke_.color);
  if (pointer_) paintPointerTag(painter, *pointer_, rect(), tag_);
  if (seen_sides_) paintSeenSides(painter);
  if (mark_) paintChip(painter, *mark_ + QPointF(14, -10), mark_word_, QColor(0xff, 0xb0, 0x20));
  if (hint_.isEmpty()) return;
  const QSizeF size = chipSize(painter, hint_);
  paintChip(painter, {(width() - size.width()) / 2, 58}, hint_, QColor(0xff, 0xd0, 0x00));
}

}  // namespace scantrove
