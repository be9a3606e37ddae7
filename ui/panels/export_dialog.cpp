#include "ui/panels/export_dialog.h"

#include <QComboBox>
#include <QDesktopServices>
#include <QDir>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QScreen>
#include <QScrollArea>
#include <QSettings>
#include <QUrl>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "core/base/overloaded.h"
#include "ui/models/shown_message.h"
#include "ui/panels/export_choices_panel.h"
#include "ui/panels/export_folder_field.h"
#include "ui/panels/export_sample_view.h"
#include "ui/panels/export_scans_panel.h"
#include "ui/panels/export_statistics_view.h"

namespace scantrove {
namespace {

const QString kFormatKey = QStringLiteral("export/format");
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

QString contentOf(const ExportSummary& summary) {
  QStringList what;
  if (summary.scans > 1) what << ExportDialog::tr("%n scans", nullptr, summary.scans);
  if (summary.images > 0) what << ExportDialog::tr("%n images", nullptr, summary.images);
  if (summary.regions > 0) what << ExportDialog::tr("%n objects", nullptr, summary.regions);
  if (summary.annotations > 0) what << ExportDialog::tr("%n masks", nullptr, summary.annotations);
  if (summary.points > 0) what << ExportDialog::tr("%1 points").arg(summary.points);
  what << ExportDialog::tr("%1 MB").arg(std::max(1L, std::lround(static_cast<double>(summary.bytes) / 1e6)));
  return what.join(QStringLiteral(", "));
}

QString notesOf(const ExportSummary& summary) {
  QString text;
  if (!summary.skipped.empty()) {
    text += ExportDialog::tr("\n%n frames are not included: %1", nullptr,
                             static_cast<int>(summary.skipped.size()))
                .arg(QString::fromStdString(summary.skipped.front()));
  }
  for (const std::string& note : summary.notes)
    text += QLatin1Char('\n') + shownMessage(QString::fromStdString(note));
  return text;
}

}  // namespace

ExportDialog::ExportDialog(const QString& name, QWidget* parent)
    : QDialog(parent),
      name_(name),
      format_(new QComboBox),
      about_(new QLabel),
      folder_(new ExportFolderField(name)),
      scans_(new ExportScansPanel),
      choices_(new ExportChoicesPanel),
      sample_(new ExportSampleView),
      statistics_(new ExportStatisticsView),
      message_(new QLabel),
      bar_(new QProgressBar),
      count_(new QPushButton(tr("Co&unt"))),
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
  message_->setWordWrap(true);
  message_->setTextFormat(Qt::PlainText);
  message_->setObjectName(QStringLiteral("exportMessage"));
  count_->setToolTip(tr("Counts images, instances and pixels of each class, and writes nothing"));
  bar_->setVisible(false);
  bar_->setTextVisible(false);  // the bar is lower than a text
  show_folder_->setVisible(false);
  export_->setDefault(true);
  export_->setProperty("primary", true);
  layOut();

  preview_timer_.setSingleShot(true);
  preview_timer_.setInterval(kPreviewDelay_ms);
  connect(&preview_timer_, &QTimer::timeout, this, [this] {
    if (isWorking()) return;
    emit posted(PreviewExport{options()});
    emit posted(SampleExport{options(), sample_->index()});
  });
  connect(sample_, &ExportSampleView::rowRequested, this, [this](int index) {
    if (!isWorking()) emit posted(SampleExport{options(), index});
  });
  connect(format_, &QComboBox::currentIndexChanged, this, &ExportDialog::formatChanged);
  connect(choices_, &ExportChoicesPanel::changed, this, &ExportDialog::choicesChanged);
  connect(scans_, &ExportScansPanel::changed, this, [this] {
    folder_->setName(scans_->isProject() ? project_ : name_);
    choicesChanged();
  });
  connect(count_, &QPushButton::clicked, this, &ExportDialog::count);
  connect(export_, &QPushButton::clicked, this, &ExportDialog::begin);
  connect(cancel_, &QPushButton::clicked, this, &ExportDialog::reject);
  connect(show_folder_, &QPushButton::clicked, this,
          [this] { QDesktopServices::openUrl(QUrl::fromLocalFile(done_folder_)); });
  formatChanged();
}

void ExportDialog::layOut() {
  auto* form = new QFormLayout;
  form->addRow(tr("F&ormat"), format_);
  form->addRow(QString(), about_);
  form->addRow(tr("Save to"), folder_);
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(show_folder_);
  buttons->addStretch(1);
  buttons->addWidget(cancel_);
  buttons->addWidget(count_);
  buttons->addWidget(export_);
  // On a small screen the options scroll; message and buttons stay visible.
  content_ = new QWidget;
  auto* column_of_choices = new QVBoxLayout(content_);
  column_of_choices->setContentsMargins(0, 0, 0, 0);
  column_of_choices->setSpacing(12);
  column_of_choices->addLayout(form);
  column_of_choices->addWidget(scans_);
  column_of_choices->addWidget(choices_);
  column_of_choices->addWidget(sample_);
  column_of_choices->addWidget(statistics_);
  column_of_choices->addStretch(1);
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
}

void ExportDialog::setProject(const QString& name, const QStringList& scans) {
  project_ = name;
  project_.replace(QLatin1Char('/'), QLatin1Char('-'));  // it becomes part of a path
  scans_->setScans(scans);
  if (isVisible()) resize(size().expandedTo(sizeHint()));  // the panel of scans has appeared
}

QSize ExportDialog::sizeHint() const {
  const QSize rest = QDialog::sizeHint() - scroll_->sizeHint();
  const QSize full = content_->sizeHint() + rest + QSize(0, kRoomForMessage_px);
  const QSize available = screen()->availableSize() - QSize(0, kRoomForTitle_px);
  return full.expandedTo({kDialogWidth_px, 0}).boundedTo(available);
}

DatasetFormat ExportDialog::format() const { return static_cast<DatasetFormat>(format_->currentIndex()); }

ExportOptions ExportDialog::options() const {
  ExportOptions options;
  options.format = format();
  options.folder = folder_->folder().toStdString();
  choices_->apply(options);
  return options;
}

QString ExportDialog::message() const { return message_->text(); }

void ExportDialog::formatChanged() {
  about_->setText(aboutFormat(format()));
  folder_->setFormat(format_->currentText().toLower());
  choicesChanged();
}

void ExportDialog::choicesChanged() {
  choices_->showFor(format(), scans_->isProject());
  statistics_->clear();
  done_folder_.clear();
  show_folder_->setVisible(false);
  preview_timer_.start();
}

void ExportDialog::handleEvent(const ScanEvent& event) {
  std::visit(Overloaded{[this](const ExportPreviewed& e) { showPreview(e.preview); },
                        [this](const ExportSampled& e) {
                          if (!isWorking()) sample_->showSample(e.sample);
                        },
                        [this](const ExportStepped& e) { showProgress(e.progress); },
                        [this](const ExportFinished& e) { showDone(e.summary); },
                        [this](const ExportFailed& e) {
                          if (!e.is_preview || !isWorking()) showFailure(e.error);
                        },
                        [](const auto&) {}},
             event);
}

void ExportDialog::showPreview(const ExportPreview& preview) {
  choices_->setClasses(preview.classes);
  if (isWorking() || !done_folder_.isEmpty()) return;
  if (scans_->isProject()) {
    message_->setText(tr("%n scans of the project. Count shows what they hold.", nullptr,
                         static_cast<int>(scans_->scans().size())));
  } else if (preview.regions == 0) {
    message_->setText(tr("Nothing would be exported. Name some regions first, or choose other labels."));
  } else {
    message_->setText(
        tr("%1, %2, about %3 MB")
            .arg(tr("%n images", nullptr, preview.images), tr("%n objects", nullptr, preview.regions))
            .arg(std::max(1L, std::lround(preview.megabytes))));
  }
}

void ExportDialog::start(Work work) {
  if (const QString problem = scans_->problem(); !problem.isEmpty()) {
    message_->setText(problem);
    return;
  }
  ExportOptions chosen = options();
  chosen.dry_run = work == Work::counting;
  done_folder_.clear();
  if (!chosen.dry_run) {
    QSettings().setValue(kFormatKey, format_->currentText());
    choices_->saveLicense();
    QDir().mkpath(QFileInfo(folder_->folder()).path());
  }
  statistics_->clear();
  setWork(work);
  message_->setText(chosen.dry_run ? tr("Counting…") : tr("Exporting…"));
  if (scans_->isProject()) {
    emit posted(ExportProject{chosen, scans_->scans(), scans_->split()});
  } else {
    emit posted(ExportDataset{chosen});
  }
}

void ExportDialog::showProgress(const ExportProgress& progress) {
  bar_->setMaximum(std::max(1, progress.total));
  bar_->setValue(progress.done);
  message_->setText(QString::fromStdString(progress.what));
}

void ExportDialog::showDone(const ExportSummary& summary) {
  const bool is_count = work_ == Work::counting;
  setWork(Work::none);
  statistics_->showCounts(summary);
  if (is_count) {
    message_->setText(tr("The data set would hold %1").arg(contentOf(summary)) + notesOf(summary));
    return;
  }
  done_folder_ = QString::fromStdString(summary.folder.string());
  message_->setText(tr("Exported %1 to %2").arg(contentOf(summary), done_folder_) + notesOf(summary));
  show_folder_->setVisible(true);
}

void ExportDialog::showFailure(const Error& error) {
  setWork(Work::none);
  message_->setText(shownMessage(QString::fromStdString(error.message())));
}

void ExportDialog::setWork(Work work) {
  work_ = work;
  bar_->setVisible(isWorking());
  bar_->setMaximum(0);
  for (QWidget* widget :
       std::initializer_list<QWidget*>{format_, folder_, scans_, choices_, sample_, count_, export_})
    widget->setEnabled(!isWorking());
  cancel_->setText(isWorking() ? tr("Cancel") : tr("Close"));
  show_folder_->setVisible(false);
}

void ExportDialog::reject() {
  if (isWorking()) {
    emit posted(CancelExport{});
    return;
  }
  QDialog::reject();
}

}  // namespace scantrove
