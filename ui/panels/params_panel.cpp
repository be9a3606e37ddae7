#include "ui/panels/params_panel.h"

#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/session/param_registry.h"
#include "ui/language/core_texts.h"

namespace scantrove {
namespace {

// The slider is logarithmic: 100 steps a decade.
constexpr double kLowestK = 0.01;
constexpr int kStepsPerDecade = 100;
constexpr int kSteps = 300;

int stepOfK(double k) { return static_cast<int>(std::lround(kStepsPerDecade * std::log10(k / kLowestK))); }
double kOfStep(int step) { return kLowestK * std::pow(10.0, static_cast<double>(step) / kStepsPerDecade); }

const ParamInfo& infoOf(const std::string& key) {
  const std::vector<ParamInfo>& all = paramRegistry();
  const auto found =
      std::find_if(all.begin(), all.end(), [&key](const ParamInfo& info) { return info.key == key; });
  SCANTROVE_CHECK(found != all.end());
  return *found;
}

QString helpOf(const ParamInfo& info) {
  return QStringLiteral("%1<br><code>%2</code>")
      .arg(coreText(info.help).toHtmlEscaped(), QString::fromStdString(info.key));
}

}  // namespace

ParamsPanel::ParamsPanel(const ScanParams& params, QWidget* parent) : QWidget(parent), params_(params) {
  // Leaves the remaining height to the object list.
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(12, 4, 12, 10);
  layout->setSpacing(8);
  layout->addWidget(makeDetailSlider());

  auto* more = new QToolButton;
  more->setObjectName(QStringLiteral("moreSettings"));
  more->setText(tr("More settings"));
  more->setCheckable(true);
  more->setArrowType(Qt::RightArrow);
  more->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  layout->addWidget(more);

  auto* box = new QWidget;
  auto* form = new QFormLayout(box);
  form->setContentsMargins(0, 0, 0, 0);
  form->setSpacing(6);
  form->setFieldGrowthPolicy(QFormLayout::ExpandingFieldsGrow);
  addField(form, "labeling.joining_bias", tr("Joining"));
  addField(form, "discovery.min_size_m", tr("Minimum object size"));
  addField(form, "discovery.max_size_m", tr("Maximum object size"));
  addField(form, "discovery.persistent_frames", tr("Found after"));
  addField(form, "detection.max_distance", tr("Recognition limit"));
  addField(form, "fusion.voxel_size_m", tr("Voxel size *"));
  addField(form, "fusion.max_depth_m", tr("Farthest depth *"));
  auto* note = new QLabel(tr("* applies to the next scan"));
  note->setProperty("muted", true);
  auto* reset = new QPushButton(tr("Defaults"));
  reset->setToolTip(tr("Reset all parameters to their defaults"));
  connect(reset, &QPushButton::clicked, this, &ParamsPanel::setDefaults);
  auto* last_row = new QHBoxLayout;
  last_row->addWidget(note, 1);
  last_row->addWidget(reset);
  form->addRow(last_row);
  layout->addWidget(box);
  layout->addStretch(1);
  box->hide();
  connect(more, &QToolButton::toggled, this, [more, box](bool open) {
    more->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
    box->setVisible(open);
  });
}

QWidget* ParamsPanel::makeDetailSlider() {
  auto* box = new QWidget;
  auto* layout = new QVBoxLayout(box);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(3);
  auto* head = new QHBoxLayout;
  head->addWidget(new QLabel(tr("Segment size, k")));
  head->addStretch(1);
  k_value_ = new QLabel;
  head->addWidget(k_value_);
  layout->addLayout(head);
  k_slider_ = new QSlider(Qt::Horizontal);
  k_slider_->setRange(0, kSteps);
  k_slider_->setPageStep(kStepsPerDecade / 10);
  k_slider_->setAccessibleName(tr("Segment size, k"));
  k_slider_->setToolTip(
      tr("A larger k gives fewer, larger segments. It takes effect at once, also on the frame that a paused "
         "or finished scan shows."));
  layout->addWidget(k_slider_);
  auto* ends = new QHBoxLayout;
  for (const QString& text : {tr("finer"), tr("coarser")}) {
    auto* label = new QLabel(text);
    label->setProperty("muted", true);
    ends->addWidget(label);
    if (ends->count() == 1) ends->addStretch(1);
  }
  layout->addLayout(ends);
  connect(k_slider_, &QSlider::valueChanged, this, [this](int step) {
    params_.segmentation.k = static_cast<float>(kOfStep(step));
    showK();
    emit changed(params_);
  });
  refreshers_.emplace_back([this] {
    const QSignalBlocker quiet(k_slider_);
    k_slider_->setValue(stepOfK(static_cast<double>(params_.segmentation.k)));
    showK();
  });
  refreshers_.back()();
  return box;
}

void ParamsPanel::showK() {
  k_value_->setText(QStringLiteral("<b>%1</b>")
                        .arg(QLocale().toString(static_cast<double>(params_.segmentation.k), 'g', 2)));
}

void ParamsPanel::addField(QFormLayout* form, const std::string& key, const QString& label) {
  const ParamInfo& info = infoOf(key);
  QWidget* field = makeField(info);
  field->setObjectName(QString::fromStdString(key));
  field->setToolTip(helpOf(info));
  field->setAccessibleName(label);
  form->addRow(label, field);
  form->labelForField(field)->setToolTip(helpOf(info));
}

QWidget* ParamsPanel::makeField(const ParamInfo& info) {
  auto* number = new QDoubleSpinBox;
  const bool is_integer = info.unit == "frames" || info.unit == "px" || info.unit == "views";
  const bool is_small = info.can_be_automatic ? info.maximum < 1 : info.get(params_) < 0.02;
  const double step = is_integer ? 1 : (is_small ? 0.0005 : 0.05);
  number->setDecimals(is_integer ? 0 : (is_small ? 4 : 2));
  number->setRange(info.minimum, info.maximum);
  number->setSingleStep(step);
  if (info.can_be_automatic) {
    number->setMinimum(info.minimum - step);
    number->setSpecialValueText(tr("auto"));
  }
  if (!info.unit.empty()) number->setSuffix(QLatin1Char(' ') + coreText(info.unit));
  number->setKeyboardTracking(false);
  connect(number, &QDoubleSpinBox::valueChanged, this, [this, &info](double entered) {
    info.set(params_, entered < info.minimum ? static_cast<double>(kAutomatic) : entered);
    emit changed(params_);
  });
  refreshers_.emplace_back([this, &info, number] {
    const QSignalBlocker quiet(number);
    number->setValue(info.isAutomatic(params_) ? number->minimum() : info.get(params_));
  });
  refreshers_.back()();
  return number;
}

void ParamsPanel::finishTyping() {
  for (QDoubleSpinBox* number : findChildren<QDoubleSpinBox*>()) number->interpretText();
}

void ParamsPanel::setDefaults() {
  params_ = ScanParams{};
  for (const auto& refresh : refreshers_) refresh();
  emit changed(params_);
}

}  // namespace scantrove
