#include "ui/panels/time_line.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QStyle>
#include <QStyleOptionSlider>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/panels/review_marks.h"

namespace scantrove {

TimeLine::TimeLine(QWidget* parent)
    : QWidget(parent),
      slider_(new QSlider(Qt::Horizontal)),
      text_(new QLabel),
      filter_box_(new QComboBox),
      marks_(new ReviewMarks(
          reviews_, [this](int index) { return placeOf(index); }, this)) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(12, 4, 12, 4);
  row->setSpacing(10);
  auto* title = new QLabel(tr("Key frames"));
  title->setProperty("muted", true);
  row->addWidget(title);
  auto* column = new QVBoxLayout;
  column->setSpacing(0);
  column->addWidget(slider_);
  column->addWidget(marks_);
  row->addLayout(column, 1);
  row->addWidget(text_);
  makeFilter();
  row->addWidget(filter_box_);
  slider_->setAccessibleName(tr("Shown key frame"));
  slider_->setToolTip(
      tr("Browse the stored frames (Page up, Page down). The labels are those of the map now."));
  slider_->setPageStep(1);
  slider_->setFocusPolicy(Qt::TabFocus);  // so that keys stay with the picture after a click
  connect(slider_, &QSlider::valueChanged, this, [this](int index) {
    showText(index);
    emit requested(index);
  });
  connect(marks_, &ReviewMarks::chosen, this, &TimeLine::go);
  connect(&reviews_, &KeyFrameReviews::changed, this, [this] { showText(slider_->value()); });
  hide();
}

void TimeLine::makeFilter() {
  filter_box_->addItems({tr("All"), tr("Open"), tr("Checked")});
  filter_box_->setAccessibleName(tr("Key frames to browse"));
  filter_box_->setToolTip(tr("Key frames that Page up and Page down go to"));
  filter_box_->setFocusPolicy(Qt::TabFocus);  // as the slider
  connect(filter_box_, &QComboBox::currentIndexChanged, this, [this] { marks_->setFilter(filter()); });
}

ReviewFilter TimeLine::filter() const {
  constexpr ReviewFilter kFilters[] = {ReviewFilter::all, ReviewFilter::open, ReviewFilter::checked};
  return kFilters[std::clamp(filter_box_->currentIndex(), 0, 2)];
}

int TimeLine::placeOf(int index) const {
  QStyleOptionSlider option;
  option.initFrom(slider_);
  option.orientation = Qt::Horizontal;
  option.minimum = slider_->minimum();
  option.maximum = slider_->maximum();
  const QRect groove =
      slider_->style()->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderGroove, slider_);
  const int handle = slider_->style()->pixelMetric(QStyle::PM_SliderLength, &option, slider_);
  const int at =
      QStyle::sliderPositionFromValue(slider_->minimum(), slider_->maximum(), index, groove.width() - handle);
  return slider_->x() + groove.x() + handle / 2 + at;
}

void TimeLine::showSnapshot(const ScanSnapshot& snapshot) {
  if (snapshot.key_frames == nullptr || snapshot.key_frames->empty()) {
    clear();
    return;
  }
  const bool is_new = key_frames_ == nullptr;
  key_frames_ = snapshot.key_frames;
  {
    const QSignalBlocker quiet(slider_);
    slider_->setMaximum(static_cast<int>(key_frames_->size()) - 1);
    // A late snapshot of an older key frame must not move the slider while the user browses.
    if (is_new && snapshot.shown_key_frame >= 0) slider_->setValue(snapshot.shown_key_frame);
  }
  reviews_.update(snapshot);
  showText(slider_->value());
  show();
}

void TimeLine::clear() {
  key_frames_.reset();
  reviews_.clear();
  filter_box_->setCurrentIndex(0);
  hide();
}

QString TimeLine::text() const { return text_->text(); }

int TimeLine::current() const { return key_frames_ == nullptr ? -1 : slider_->value(); }

void TimeLine::go(int index) {
  if (key_frames_ != nullptr) slider_->setValue(index);
}

void TimeLine::step(int count) {
  if (key_frames_ == nullptr) return;
  if (filter() == ReviewFilter::all) return slider_->setValue(slider_->value() + count);
  const int index = reviews_.next(slider_->value(), count, filter());
  if (index >= 0) go(index);
}

void TimeLine::showText(int index) {
  if (key_frames_ == nullptr) return;
  const int at = std::clamp(index, 0, static_cast<int>(key_frames_->size()) - 1);
  QString text = tr("%1 of %2 (frame %3)")
                     .arg(at + 1)
                     .arg(key_frames_->size())
                     .arg((*key_frames_)[static_cast<std::size_t>(at)]);
  const FrameReview* const review = reviews_.at(at);
  if (review != nullptr && review->state != ReviewState::open)
    text += QStringLiteral(" · ") + inWords(review->state);
  text_->setText(text);
  marks_->setCurrent(at);
}

}  // namespace scantrove
