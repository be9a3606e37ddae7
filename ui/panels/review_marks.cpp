#include "ui/panels/review_marks.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <cstdlib>
#include <utility>

#include "ui/theme/theme.h"

namespace scantrove {
namespace {

constexpr int kMarksHeight_px = 11;
constexpr double kRadius_px = 3;
constexpr double kPale = 0.25;

void paintMark(QPainter& painter, const QPointF& middle, ReviewState state) {
  const ThemeColors& colors = Theme::instance().colors();
  const double r = kRadius_px;
  painter.setBrush(Qt::NoBrush);
  switch (state) {
    case ReviewState::open:
      painter.setPen(QPen(colors.muted_text, 1.2));
      painter.drawEllipse(middle, r, r);
      break;
    case ReviewState::checked:
      painter.setPen(Qt::NoPen);
      painter.setBrush(colors.good);
      painter.drawEllipse(middle, r + 0.6, r + 0.6);
      break;
    case ReviewState::left_out:
      painter.setPen(QPen(colors.bad, 1.8));
      painter.drawLine(middle + QPointF(-r, -r), middle + QPointF(r, r));
      painter.drawLine(middle + QPointF(-r, r), middle + QPointF(r, -r));
      break;
  }
}

}  // namespace

QString inWords(ReviewState state) {
  switch (state) {
    case ReviewState::open:
      return ReviewMarks::tr("open");
    case ReviewState::checked:
      return ReviewMarks::tr("checked");
    case ReviewState::left_out:
      return ReviewMarks::tr("left out");
  }
  return {};
}

ReviewMarks::ReviewMarks(const KeyFrameReviews& reviews, std::function<int(int index)> place_of,
                         QWidget* parent)
    : QWidget(parent), reviews_(reviews), place_of_(std::move(place_of)) {
  setFixedHeight(kMarksHeight_px);
  setCursor(Qt::PointingHandCursor);
  setAccessibleName(tr("Review states of the key frames"));
  connect(&reviews_, &KeyFrameReviews::changed, this, qOverload<>(&QWidget::update));
  connect(&Theme::instance(), &Theme::changed, this, qOverload<>(&QWidget::update));
}

void ReviewMarks::setCurrent(int index) {
  current_ = index;
  update();
}

void ReviewMarks::setFilter(ReviewFilter filter) {
  filter_ = filter;
  update();
}

int ReviewMarks::middleOf(int index) const {
  return mapFrom(parentWidget(), QPoint(place_of_(index), 0)).x();
}

void ReviewMarks::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const auto count = static_cast<int>(reviews_.all().size());
  for (int i = 0; i < count; ++i) {
    const FrameReview& review = *reviews_.at(i);
    const QPointF middle(middleOf(i) + 0.5, height() / 2.0);
    painter.setOpacity(passes(review.state, filter_) ? 1 : kPale);
    paintMark(painter, middle, review.state);
  }
  if (reviews_.at(current_) == nullptr) return;
  painter.setOpacity(1);
  painter.setPen(QPen(Theme::instance().colors().accent, 1.2));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(QRectF(middleOf(current_) - 4.5, 0.5, 10, height() - 1.0));
}

int ReviewMarks::nearestTo(int x) const {
  int nearest = -1;
  const auto count = static_cast<int>(reviews_.all().size());
  for (int i = 0; i < count; ++i) {
    if (nearest < 0 || std::abs(middleOf(i) - x) < std::abs(middleOf(nearest) - x)) nearest = i;
  }
  return nearest;
}

void ReviewMarks::mousePressEvent(QMouseEvent* event) {
  const int index = nearestTo(event->position().toPoint().x());
  if (index >= 0) emit chosen(index);
}

bool ReviewMarks::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  const auto* const help = static_cast<QHelpEvent*>(event);
  const FrameReview* const review = reviews_.at(nearestTo(help->pos().x()));
  if (review != nullptr)
    QToolTip::showText(help->globalPos(), tr("Frame %1: %2").arg(review->image).arg(inWords(review->state)),
                       this);
  return true;
}

}  // namespace scantrove
