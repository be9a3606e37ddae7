#include "ui/panels/export_sample_view.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPixmap>
#include <QShortcut>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/panels/image_conversion.h"

namespace scantrove {
namespace {

constexpr QSize kPictureSize(400, 300);

}  // namespace

ExportSampleView::ExportSampleView(QWidget* parent)
    : QWidget(parent),
      picture_(new QLabel),
      caption_(new QLabel),
      back_(new QToolButton),
      on_(new QToolButton) {
  picture_->setFixedHeight(kPictureSize.height());
  picture_->setAlignment(Qt::AlignCenter);
  picture_->setWordWrap(true);
  picture_->setAccessibleName(tr("An image of the data set with its masks"));
  caption_->setAlignment(Qt::AlignCenter);
  caption_->setProperty("muted", true);
  back_->setArrowType(Qt::LeftArrow);
  back_->setToolTip(tr("Previous image (Page up)"));
  back_->setAccessibleName(tr("Previous image"));
  on_->setArrowType(Qt::RightArrow);
  on_->setToolTip(tr("Next image (Page down)"));
  on_->setAccessibleName(tr("Next image"));
  auto* row = new QHBoxLayout;
  row->addWidget(back_);
  row->addWidget(caption_, 1);
  row->addWidget(on_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  column->addWidget(picture_);
  column->addLayout(row);
  connect(back_, &QToolButton::clicked, this, [this] { step(-1); });
  connect(on_, &QToolButton::clicked, this, [this] { step(1); });
  for (const auto& [key, by] : {std::pair(Qt::Key_PageUp, -1), std::pair(Qt::Key_PageDown, 1)}) {
    auto* shortcut = new QShortcut(QKeySequence(key), this);
    connect(shortcut, &QShortcut::activated, this, [this, by = by] { step(by); });
  }
  updateButtons();
}

void ExportSampleView::showSample(const ExportSample& sample) {
  count_ = sample.count;
  setVisible(count_ > 0);
  index_ = count_ > 0 ? std::optional(sample.index) : std::nullopt;
  updateButtons();
  if (!sample.picture.empty()) {
    const QImage picture = colorPicture(sample.picture);
    const double ratio = devicePixelRatioF();
    QPixmap shown = QPixmap::fromImage(
        picture.scaled(kPictureSize * ratio, Qt::KeepAspectRatio, Qt::SmoothTransformation));
    shown.setDevicePixelRatio(ratio);
    picture_->setPixmap(shown);
  } else {
    picture_->setText(sample.problem.empty()
                          ? QString()
                          : tr("This image is not included: %1").arg(QString::fromStdString(sample.problem)));
  }
  caption_->setText(tr("Frame %1 — %2 of %3 — %n masks", nullptr, sample.masks)
                        .arg(sample.frame)
                        .arg(sample.index + 1)
                        .arg(sample.count));
}

QString ExportSampleView::caption() const { return caption_->text(); }

bool ExportSampleView::hasPicture() const { return !picture_->pixmap().isNull(); }

void ExportSampleView::step(int by) {
  if (!index_ || !isEnabled()) return;
  const int requested = std::clamp(*index_ + by, 0, count_ - 1);
  if (requested == *index_) return;
  index_ = requested;  // so that quick steps add up
  updateButtons();
  emit rowRequested(requested);
}

void ExportSampleView::updateButtons() {
  back_->setEnabled(index_ && *index_ > 0);
  on_->setEnabled(index_ && *index_ + 1 < count_);
}

}  // namespace scantrove
