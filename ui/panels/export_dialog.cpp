#include "ui/panels/export_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDesktopServices>
#include <QDir>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QScreen>
#include <QScrollArea>
#include <QSettings>
#include <QStandardPaths>
#include <QUrl>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/base/overloaded.h"
#include "ui/panels/export_sample_view.h"
#include "ui/panels/file_dialogs.h"

namespace scantrove {
namespace {

const QString kFormatKey = QStringLiteral("export/format");
const QString kLicenseKey = QStringLiteral("export/license");
const QString kFolderKey = QStringLiteral("export/folder");
constexpr int kPreviewDelay_ms = 200;
constexpr int kDialogWidth_px = 560;
constexpr int kRoomForMessage_px = 40;  ///< messages of an export may need more lines
constexpr int kRoomForTitle_px = 40;

QString aboutFormat(DatasetFormat format) {
  switch (format) {
    case DatasetFormat::coco:
      return ExportDialog::tr(
          "COCO instances: images and one JSON file with masks (pycocotools, CVAT, FiftyOne)");
    case DatasetFormat::bop:
      return ExportDialog::tr("BOP: colour, depth, masks, poses and models of the objects (bop_toolkit)");
    case DatasetFormat::yolo:
      return ExportDialog::tr("YOLO segments: outlines as polygons (ultralytics)");
    case DatasetFormat::masks:
      return ExportDialog::tr("Masks: a 16-bit image of region numbers per frame, and a list of names");
    case DatasetFormat::voc:
      return ExportDialog::tr("Pascal VOC: images, boxes as XML, and palette images (torchvision, CVAT)");
    case DatasetFormat::labelstudio:
      return ExportDialog::tr("Label Studio: images, and tasks with brush masks to import");
    case DatasetFormat::boxes:
      return ExportDialog::tr(
          "3D boxes: upright boxes with the cloud (labelCloud) and for each frame (SUN RGB-D)");
    case DatasetFormat::foundationpose:
      return ExportDialog::tr(
          "FoundationPose: a folder per object with images, depth, masks, poses and its model");
    case DatasetFormat::ply:
      return ExportDialog::tr("PLY: the labelled coloured cloud (CloudCompare, MeshLab)");
    case DatasetFormat::pcd:
      return ExportDialog::tr("PCD: the labelled coloured cloud (PCL)");
    case DatasetFormat::mesh:
      return ExportDialog::tr("Meshes: the scene and each object as PLY, OBJ and GLB (Blender, MeshLab)");
    case DatasetFormat::tum:
      return ExportDialog::tr("TUM: the trajectory of the camera (evo)");
    case DatasetFormat::scannet:
      return ExportDialog::tr("ScanNet: mesh, segments and objects (ScanNet's tools)");
  }
  return {};
}

}  // namespace

ExportDialog::ExportDialog(const QString& name, QWidget* parent)
    : QDialog(parent),
      name_(name),
      format_(new QComboBox),
      about_(new QLabel),
      folder_(new QLineEdit),
      all_frames_(new QCheckBox(tr("All &stored frames, not only key frames"))),
      background_(new QCheckBox(tr("Include &background and rejected regions"))),
      include_unfit_(new QCheckBox(tr("Include &unfit frames"))),
      license_(new QLineEdit),
      sample_(new ExportSampleView),
      message_(new QLabel),
      bar_(new QProgressBar),
      export_(new QPushButton(tr("&Export"))),
      cancel_(new QPushButton(tr("Close"))),
      show_folder_(new QPushButton(tr("Open the &folder"))) {
  setWindowTitle(tr("Export data set"));
  setMinimumWidth(520);
  for (const std::string& known : datasetFormatNames())
    format_->addItem(QString::fromStdString(known).toUpper());
  format_->setCurrentIndex(std::max(0, format_->findText(QSettings().value(kFormatKey).toString())));
  format_->setAccessibleName(tr("Format"));
  about_->setWordWrap(true);
  about_->setProperty("muted", true);
  folder_->setAccessibleName(tr("Folder"));
  license_->setAccessibleName(tr("License"));
  license_->setText(QSettings().value(kLicenseKey).toString());
  license_->setPlaceholderText(tr("none, or for example CC BY 4.0"));
  license_->setToolTip(tr("Written into the data set's README and LICENSE.txt"));
  message_->setWordWrap(true);
  message_->setObjectName(QStringLiteral("exportMessage"));
  include_unfit_->setToolTip(tr("Frames that are blurred, or whose depth and colour do not fit"));
  bar_->setVisible(false);
  show_folder_->setVisible(false);
  export_->setDefault(true);
  export_->setProperty("primary", true);

  auto* form = new QFormLayout;
  form->addRow(tr("F&ormat"), format_);
  form->addRow(QString(), about_);
  auto* folder_row = new QHBoxLayout;
  folder_row->addWidget(folder_, 1);
  auto* choose_button = new QPushButton(tr("&Choose…"));
  folder_row->addWidget(choose_button);
  form->addRow(tr("Save to"), folder_row);
  form->addRow(QString(), all_frames_);
  form->addRow(QString(), background_);
  form->addRow(QString(), include_unfit_);
  form->addRow(tr("&License"), license_);
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(show_folder_);
  buttons->addStretch(1);
  buttons->addWidget(cancel_);
  buttons->addWidget(export_);
  // On a small screen the options scroll; message and buttons stay visible.
  content_ = new QWidget;
  auto* choices = new QVBoxLayout(content_);
  choices->setContentsMargins(0, 0, 0, 0);
  choices->setSpacing(12);
  choices->addLayout(form);
  choices->addWidget(sample_);
  choices->addStretch(1);
  scroll_ = new QScrollArea;
  scroll_->setWidget(content_);
  scroll_->setWidgetResizable(true);
  scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll_->viewport()->setAutoFillBackground(false);
  content_->setAutoFillBackground(false);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(16, 16, 16, 14);
  column->setSpacing(12);
  column->addWidget(scroll_, 1);
  column->addWidget(message_);
  column->addWidget(bar_);
  column->addLayout(buttons);

  preview_timer_.setSingleShot(true);
  preview_timer_.setInterval(kPreviewDelay_ms);
  connect(&preview_timer_, &QTimer::timeout, this, [this] {
    if (is_working_) return;
    emit posted(PreviewExport{options()});
    emit posted(SampleExport{options(), sample_->index()});
  });
  connect(sample_, &ExportSampleView::rowRequested, this, [this](int index) {
    if (!is_working_) emit posted(SampleExport{options(), index});
  });
  connect(format_, &QComboBox::currentIndexChanged, this, &ExportDialog::formatChanged);
  connect(all_frames_, &QCheckBox::toggled, this, &ExportDialog::requestPreview);
  connect(background_, &QCheckBox::toggled, this, &ExportDialog::requestPreview);
  connect(choose_button, &QPushButton::clicked, this, &ExportDialog::choose);
  connect(export_, &QPushButton::clicked, this, &ExportDialog::begin);
  connect(cancel_, &QPushButton::clicked, this, &ExportDialog::reject);
  connect(show_folder_, &QPushButton::clicked, this,
          [this] { QDesktopServices::openUrl(QUrl::fromLocalFile(done_folder_)); });
  formatChanged();
}

QSize ExportDialog::sizeHint() const {
  const QSize rest = QDialog::sizeHint() - scroll_->sizeHint();
  const QSize full = content_->sizeHint() + rest + QSize(0, kRoomForMessage_px);
  const QSize available = screen()->availableSize() - QSize(0, kRoomForTitle_px);
  return full.expandedTo({kDialogWidth_px, 0}).boundedTo(available);
}

ExportOptions ExportDialog::options() const {
  ExportOptions options;
  options.format = static_cast<DatasetFormat>(format_->currentIndex());
  options.folder = folder_->text().toStdString();
  options.all_frames = all_frames_->isChecked();
  options.background = background_->isChecked();
  options.include_unfit = include_unfit_->isChecked();
  options.license = license_->text().trimmed().toStdString();
  return options;
}

QString ExportDialog::proposedFolder() const {
  const QString documents = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  const QString parent = QSettings().value(kFolderKey, documents).toString();
  const QString base =
      parent + QLatin1Char('/') + name_ + QLatin1Char('-') + format_->currentText().toLower();
  QString folder = base;
  for (int i = 2; QFileInfo::exists(folder); ++i) folder = base + QLatin1Char('-') + QString::number(i);
  return folder;
}

QString ExportDialog::message() const { return message_->text(); }

void ExportDialog::choose() {
  const QString parent = chooseFolder(this, tr("Folder of the data set"), QFileInfo(folder_->text()).path());
  if (parent.isEmpty()) return;
  QSettings().setValue(kFolderKey, parent);
  folder_->setText(proposedFolder());
}

void ExportDialog::formatChanged() {
  about_->setText(aboutFormat(static_cast<DatasetFormat>(format_->currentIndex())));
  folder_->setText(proposedFolder());
  requestPreview();
}

void ExportDialog::requestPreview() { preview_timer_.start(); }

void ExportDialog::handleEvent(const ScanEvent& event) {
  std::visit(Overloaded{[this](const ExportPreviewed& e) { showPreview(e.preview); },
                        [this](const ExportSampled& e) {
                          if (!is_working_) sample_->showSample(e.sample);
                        },
                        [this](const ExportStepped& e) { showProgress(e.progress); },
                        [this](const ExportFinished& e) { showDone(e.summary); },
                        [this](const ExportFailed& e) { showFailure(e.error); }, [](const auto&) {}},
             event);
}

void ExportDialog::showPreview(const ExportPreview& preview) {
  if (is_working_ || !done_folder_.isEmpty()) return;
  message_->setText(preview.regions == 0 ? tr("No region has a name or is an object yet, so only background "
                                              "could be exported. Name some regions first.")
                                         : tr("%1 images, %2 objects, about %3 MB")
                                               .arg(preview.images)
                                               .arg(preview.regions)
                                               .arg(std::max(1L, std::lround(preview.megabytes))));
}

void ExportDialog::begin() {
  done_folder_.clear();
  QSettings().setValue(kFormatKey, format_->currentText());
  QSettings().setValue(kLicenseKey, license_->text());
  QDir().mkpath(QFileInfo(folder_->text()).path());
  setWorking(true);
  message_->setText(tr("Exporting…"));
  emit posted(ExportDataset{options()});
}

void ExportDialog::showProgress(const ExportProgress& progress) {
  bar_->setMaximum(std::max(1, progress.total));
  bar_->setValue(progress.done);
  message_->setText(QString::fromStdString(progress.what));
}

void ExportDialog::showDone(const ExportSummary& summary) {
  setWorking(false);
  done_folder_ = QString::fromStdString(summary.folder.string());
  QStringList what;
  if (summary.images > 0) what << tr("%1 images").arg(summary.images);
  if (summary.regions > 0) what << tr("%1 objects").arg(summary.regions);
  if (summary.annotations > 0) what << tr("%1 masks").arg(summary.annotations);
  if (summary.points > 0) what << tr("%1 points").arg(summary.points);
  what << tr("%1 MB").arg(std::max(1L, std::lround(static_cast<double>(summary.bytes) / 1e6)));
  QString text = tr("Exported %1 to %2").arg(what.join(QStringLiteral(", ")), done_folder_);
  if (!summary.skipped.empty())
    text += tr("\n%1 frames are not included: %2")
                .arg(summary.skipped.size())
                .arg(QString::fromStdString(summary.skipped.front()));
  for (const std::string& note : summary.notes) text += QLatin1Char('\n') + QString::fromStdString(note);
  message_->setText(text);
  show_folder_->setVisible(true);
}

void ExportDialog::showFailure(const Error& error) {
  setWorking(false);
  message_->setText(QString::fromStdString(error.message()));
}

void ExportDialog::setWorking(bool working) {
  is_working_ = working;
  bar_->setVisible(working);
  bar_->setMaximum(0);
  for (QWidget* widget : std::initializer_list<QWidget*>{format_, folder_, all_frames_, background_,
                                                         include_unfit_, license_, sample_, export_})
    widget->setEnabled(!working);
  cancel_->setText(working ? tr("Cancel") : tr("Close"));
  show_folder_->setVisible(false);
}

void ExportDialog::reject() {
  if (is_working_) {
    emit posted(CancelExport{});
    return;
  }
  QDialog::reject();
}

}  // namespace scantrove
