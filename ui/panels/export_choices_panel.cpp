#include "ui/panels/export_choices_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QLineEdit>
#include <QListWidget>
#include <QSettings>
#include <QSignalBlocker>
#include <QSpinBox>
#include <algorithm>
#include <initializer_list>

namespace scantrove {
namespace {

const QString kExportLicenseKey = QStringLiteral("export/license");
constexpr int kClassRows = 4, kMaxValidation_pct = 90, kUsualValidation_pct = 20;

}  // namespace

ExportChoicesPanel::ExportChoicesPanel(QWidget* parent)
    : QWidget(parent),
      all_frames_(new QCheckBox(tr("All &stored frames, not only key frames"))),
      background_(new QCheckBox(tr("Include &background and rejected regions"))),
      include_unfit_(new QCheckBox(tr("Include &unfit frames"))),
      checked_only_(new QCheckBox(tr("Only chec&ked key frames"))),
      textures_(new QCheckBox(tr("&Textures"))),
      labels_(new QComboBox),
      unlabeled_(new QComboBox),
      classes_(new QListWidget),
      validation_(new QSpinBox),
      license_(new QLineEdit) {
  // In the order of the enumerations.
  labels_->addItems({tr("All objects and names"), tr("What has a name"), tr("Confirmed objects")});
  labels_->setAccessibleName(tr("Labels"));
  unlabeled_->addItems({tr("Count them"), tr("Mark as regions to ignore"), tr("Leave them")});
  unlabeled_->setAccessibleName(tr("Objects without a label"));
  unlabeled_->setToolTip(
      tr("Objects that images show and that are not exported. COCO, masks and VOC can mark them, so that a "
         "learner does not take them for background."));
  classes_->setAccessibleName(tr("Classes"));
  classes_->setToolTip(tr("Only the ticked classes are exported; without ticks all are"));
  classes_->setMaximumHeight(kClassRows * fontMetrics().lineSpacing() + 2 * classes_->frameWidth());
  validation_->setRange(0, kMaxValidation_pct);
  validation_->setValue(kUsualValidation_pct);
  validation_->setSuffix(tr(" % of the frames, the last ones"));
  validation_->setAccessibleName(tr("Validation"));
  license_->setAccessibleName(tr("License"));
  license_->setText(QSettings().value(kExportLicenseKey).toString());
  license_->setPlaceholderText(tr("none, or for example CC BY 4.0"));
  license_->setToolTip(tr("Written into the data set's README and LICENSE.txt"));
  include_unfit_->setToolTip(tr("Frames that are blurred, or whose depth and colour do not fit"));
  checked_only_->setToolTip(tr("Only key frames that you have checked in the review"));
  textures_->setToolTip(tr("OBJ and GLB show the colour images of the key frames"));

  auto* form = new QFormLayout(this);
  form->setContentsMargins(0, 0, 0, 0);
  form->addRow(tr("L&abels"), labels_);
  form->addRow(tr("U&nlabelled"), unlabeled_);
  form->addRow(tr("Classes"), classes_);
  form->addRow(tr("&Validation"), validation_);
  form->addRow(QString(), all_frames_);
  form->addRow(QString(), background_);
  form->addRow(QString(), include_unfit_);
  form->addRow(QString(), checked_only_);
  form->addRow(QString(), textures_);
  form->addRow(tr("&License"), license_);
  for (QCheckBox* box : {all_frames_, background_, include_unfit_, checked_only_, textures_})
    connect(box, &QCheckBox::toggled, this, &ExportChoicesPanel::changed);
  for (QComboBox* box : {labels_, unlabeled_})
    connect(box, &QComboBox::currentIndexChanged, this, &ExportChoicesPanel::changed);
  connect(classes_, &QListWidget::itemChanged, this, &ExportChoicesPanel::changed);
}

void ExportChoicesPanel::apply(ExportOptions& options) const {
  options.all_frames = all_frames_->isChecked();
  options.background = background_->isChecked();
  options.include_unfit = include_unfit_->isChecked();
  options.checked_only = checked_only_->isChecked();
  options.texture_size_px = textures_->isChecked() && !textures_->isHidden() ? kMaxTexture_px : 0;
  options.license = license_->text().trimmed().toStdString();
  options.choices.labels = static_cast<ExportedLabels>(labels_->currentIndex());
  options.choices.unlabeled = static_cast<UnlabeledObjects>(unlabeled_->currentIndex());
  options.choices.classes = chosenClasses();
  constexpr double kPerCent = 0.01;
  options.choices.validation_share = kPerCent * validation_->value();
}

void ExportChoicesPanel::showFor(DatasetFormat format, bool is_project) {
  const bool divides_frames = format == DatasetFormat::yolo || format == DatasetFormat::voc;
  validation_->setEnabled(divides_frames && !is_project);
  textures_->setVisible(format == DatasetFormat::mesh);
  for (QWidget* widget :
       std::initializer_list<QWidget*>{unlabeled_, all_frames_, include_unfit_, checked_only_})
    widget->setEnabled(hasImages(format));
}

void ExportChoicesPanel::setClasses(const std::vector<std::string>& classes) {
  const std::vector<std::string> chosen = chosenClasses();
  std::vector<std::string> shown;
  for (int row = 0; row < classes_->count(); ++row)
    shown.push_back(classes_->item(row)->text().toStdString());
  if (shown == classes) return;
  const QSignalBlocker quiet(classes_);
  classes_->clear();
  for (const std::string& name : classes) {
    auto* item = new QListWidgetItem(QString::fromStdString(name), classes_);
    item->setFlags(Qt::ItemIsUserCheckable | Qt::ItemIsEnabled | Qt::ItemIsSelectable);
    const bool is_chosen = std::find(chosen.begin(), chosen.end(), name) != chosen.end();
    item->setCheckState(is_chosen ? Qt::Checked : Qt::Unchecked);
  }
}

std::vector<std::string> ExportChoicesPanel::chosenClasses() const {
  std::vector<std::string> chosen;
  for (int row = 0; row < classes_->count(); ++row) {
    const QListWidgetItem* item = classes_->item(row);
    if (item->checkState() == Qt::Checked) chosen.push_back(item->text().toStdString());
  }
  return chosen;
}

void ExportChoicesPanel::saveLicense() const { QSettings().setValue(kExportLicenseKey, license_->text()); }

}  // namespace scantrove
