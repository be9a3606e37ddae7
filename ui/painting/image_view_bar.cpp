#include "ui/painting/image_view_bar.h"

#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QSettings>
#include <QSlider>
#include <algorithm>

#include "ui/theme/icon.h"

namespace scantrove {
namespace {

const QString kStyleKey = QStringLiteral("image/masks");
const QString kOpacityKey = QStringLiteral("image/opacity");
const QString kNamesKey = QStringLiteral("image/names");
constexpr int kUsualOpacity = 45;  // of 100
constexpr int kStyles = 3;

void setKeyInImage(QAction* action, const QString& key, const QString& help) {
  action->setShortcut(QKeySequence(key));
  action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  action->setToolTip(
      QStringLiteral("%1 (%2)").arg(help, action->shortcut().toString(QKeySequence::NativeText)));
}

}  // namespace

ImageViewBar::ImageViewBar(QWidget* parent)
    : QToolBar(parent),
      pictures_(new QComboBox),
      style_action_(new QAction(icon(QStringLiteral("masks")), {}, this)),
      names_(new QAction(icon(QStringLiteral("name-tag")), tr("Names"), this)),
      beside_(new QAction(icon(QStringLiteral("side-by-side")), tr("3D view beside"), this)) {
  setObjectName(QStringLiteral("imageViewBar"));
  setIconSize({20, 20});
  pictures_->setFocusPolicy(Qt::TabFocus);
  pictures_->setAccessibleName(tr("Picture"));
  pictures_->setToolTip(tr("The picture that is shown (V: next)"));
  addWidget(pictures_);
  connect(pictures_, &QComboBox::currentIndexChanged, this, &ImageViewBar::changed);
  addSeparator();
  setKeyInImage(style_action_, tr("M"), tr("Masks filled, as outlines, or not at all"));
  connect(style_action_, &QAction::triggered, this,
          [this] { setStyle(static_cast<MaskStyle>((static_cast<int>(style_) + 1) % kStyles)); });
  setKeyInImage(names_, tr("Shift+M"), tr("Names of regions"));
  names_->setCheckable(true);
  names_->setChecked(QSettings().value(kNamesKey, true).toBool());
  connect(names_, &QAction::toggled, this, [this](bool on) {
    QSettings().setValue(kNamesKey, on);
    emit changed();
  });
  addActions({style_action_, names_});
  opacity_ = addSlider(tr("Masks"), tr("Opacity of the masks"),
                       QSettings().value(kOpacityKey, kUsualOpacity).toInt());
  connect(opacity_, &QSlider::valueChanged, this,
          [](int value) { QSettings().setValue(kOpacityKey, value); });
  comparison_ = addSlider(tr("Fused depth"), tr("Blend the depth of the map over the picture"), 0);
  addSeparator();
  setKeyInImage(beside_, tr("D"), tr("3D view beside the image, from its camera"));
  beside_->setCheckable(true);
  connect(beside_, &QAction::toggled, this, &ImageViewBar::besideToggled);
  addAction(beside_);
  setStyle(static_cast<MaskStyle>(std::clamp(QSettings().value(kStyleKey, 0).toInt(), 0, kStyles - 1)));
}

QSlider* ImageViewBar::addSlider(const QString& name, const QString& help, int value) {
  auto* label = new QLabel(name);
  label->setContentsMargins(8, 0, 4, 0);
  addWidget(label);
  auto* slider = new QSlider(Qt::Horizontal);
  slider->setRange(0, 100);
  slider->setValue(value);
  slider->setMaximumWidth(110);
  slider->setFocusPolicy(Qt::TabFocus);
  slider->setToolTip(help);
  slider->setAccessibleName(help);
  connect(slider, &QSlider::valueChanged, this, &ImageViewBar::changed);
  addWidget(slider);
  return slider;
}

void ImageViewBar::setStyle(MaskStyle style) {
  style_ = style;
  QSettings().setValue(kStyleKey, static_cast<int>(style));
  style_action_->setText(style == MaskStyle::fill      ? tr("Masks: filled")
                         : style == MaskStyle::outline ? tr("Masks: outlines")
                                                       : tr("Masks: off"));
  emit changed();
}

void ImageViewBar::setPictures(const QStringList& titles) {
  pictures_->clear();
  pictures_->addItems(titles);
}

int ImageViewBar::picture() const { return pictures_->currentIndex(); }
void ImageViewBar::setPicture(int index) { pictures_->setCurrentIndex(index); }
void ImageViewBar::nextPicture() {
  if (pictures_->count() > 0) setPicture((picture() + 1) % pictures_->count());
}
bool ImageViewBar::showsNames() const { return names_->isChecked(); }
double ImageViewBar::masksOpacity() const { return opacity_->value() / 100.0; }
double ImageViewBar::comparison() const { return comparison_->value() / 100.0; }

}  // namespace scantrove
