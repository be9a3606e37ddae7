#include "ui/panels/time_line.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <algorithm>

namespace scantrove {

TimeLine::TimeLine(QWidget* parent)
    : QWidget(parent), slider_(new QSlider(Qt::Horizontal)), text_(new QLabel) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(12, 4, 12, 6);
  row->setSpacing(10);
  auto* title = new QLabel(tr("Key frames"));
  title->setProperty("muted", true);
  row->addWidget(title);
  row->addWidget(slider_, 1);
  row->addWidget(text_);
  slider_->setAccessibleName(tr("Shown key frame"));
  slider_->setToolTip(
      tr("Browse the stored frames (Page up, Page down). The labels are those of the map now."));
  slider_->setPageStep(1);
  connect(slider_, &QSlider::valueChanged, this, [this](int index) {
    showText(index);
    emit requested(index);
  });
  hide();
}

void TimeLine::showSnapshot(const ScanSnapshot& snapshot) {
  if (snapshot.key_frames == nullptr || snapshot.key_frames->empty()) {
    clear();
    return;
  }
  const bool is_new = key_frames_ == nullptr;
  key_frames_ = snapshot.key_frames;
  const QSignalBlocker quiet(slider_);
  slider_->setMaximum(static_cast<int>(key_frames_->size()) - 1);
  // A late snapshot of an older key frame must not move the slider while the user browses.
  if (is_new && snapshot.shown_key_frame >= 0) slider_->setValue(snapshot.shown_key_frame);
  showText(slider_->value());
  show();
}

void TimeLine::clear() {
  key_frames_.reset();
  hide();
}

QString TimeLine::text() const { return text_->text(); }

void TimeLine::step(int count) {
  if (key_frames_ != nullptr) slider_->setValue(slider_->value() + count);
}

void TimeLine::showText(int index) {
  if (key_frames_ == nullptr) return;
  const auto at = static_cast<std::size_t>(std::clamp(index, 0, static_cast<int>(key_frames_->size()) - 1));
  text_->setText(tr("%1 of %2 (frame %3)").arg(at + 1).arg(key_frames_->size()).arg((*key_frames_)[at]));
}

}  // namespace scantrove
