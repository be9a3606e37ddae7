#include "ui/panels/progress_strip.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QToolButton>
#include <algorithm>

#include "ui/panels/elided_label.h"

namespace scantrove {

ProgressStrip::ProgressStrip(QAction* skip, QWidget* parent)
    : QWidget(parent),
      title_(new ElidedLabel),
      bar_(new QProgressBar),
      count_(new QLabel),
      skip_(new QToolButton) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(10, 0, 10, 0);
  layout->setSpacing(14);
  QFont bold = title_->font();
  bold.setWeight(QFont::DemiBold);
  title_->setFont(bold);
  bar_->setTextVisible(false);
  bar_->setAccessibleName(tr("Progress of the scan"));
  bar_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  count_->setProperty("muted", true);
  layout->addWidget(title_);
  layout->addWidget(bar_, 1);
  layout->addWidget(count_);
  layout->addWidget(skip_);
  skip_->setObjectName(QStringLiteral("skipRefinement"));
  skip_->setDefaultAction(skip);
  skip_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  clear();
}

void ProgressStrip::begin(const QString& title) {
  title_->setFullText(title);
  count_->setMinimumWidth(0);
  setCount({});
  bar_->setRange(0, 0);
  bar_->show();
  since_start_.start();
}

void ProgressStrip::clear() {
  title_->setFullText({});
  setCount({});
  bar_->hide();
  showState(ScanState::idle);
}

void ProgressStrip::showState(ScanState state) {
  is_refining_ = state == ScanState::refining;
  skip_->setVisible(is_refining_);
  if (is_refining_) setCount({});  // clears the frame count
}

void ProgressStrip::showRefinement(const RefinementStepped& progress) {
  if (!is_refining_) return;
  bar_->setUpdatesEnabled(false);  // as in showSnapshot()
  bar_->setRange(0, progress.steps);
  bar_->setValue(progress.done);
  bar_->setUpdatesEnabled(true);
  bar_->show();
  setCount(tr("key frame %1 of %2").arg(progress.keyFrame()).arg(progress.key_frames));
}

QString ProgressStrip::text() const { return count_->text(); }

void ProgressStrip::showSnapshot(const ScanSnapshot& snapshot) {
  if (is_refining_) return;
  if (snapshot.frames_total > 0) {
    // Setting a bar repaints it and the window with its OpenGL view at once, which takes about 30 ms. With
    // updates disabled it is painted together with the other changes.
    bar_->setUpdatesEnabled(false);
    bar_->setRange(0, snapshot.frames_total);
    bar_->setValue(snapshot.frames.done());
    bar_->setUpdatesEnabled(true);
    bar_->show();
    setCount(tr("%1 of %n frames", nullptr, snapshot.frames_total).arg(snapshot.frames.done()));
    return;
  }
  bar_->hide();
  const qint64 seconds = since_start_.isValid() ? since_start_.elapsed() / 1000 : 0;
  setCount(tr("%1:%2   %n frames", nullptr, snapshot.frames.done())
               .arg(seconds / 60)
               .arg(seconds % 60, 2, 10, QLatin1Char('0')));
}

void ProgressStrip::setCount(const QString& text) {
  count_->setText(text);
  // The width only grows, so that the other widgets do not move with every frame.
  count_->setMinimumWidth(std::max(count_->minimumWidth(), count_->sizeHint().width()));
}

}  // namespace scantrove
