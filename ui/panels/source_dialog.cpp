#include "ui/panels/source_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>

#include "ui/panels/file_dialogs.h"

namespace scantrove {
namespace {

QSpinBox* numberField(int minimum, int value, const QString& special = {}) {
  auto* box = new QSpinBox;
  box->setRange(minimum, 1'000'000);
  box->setSpecialValueText(special);
  box->setValue(value);
  return box;
}

}  // namespace

std::optional<Intrinsics> parseIntrinsics(const QString& text) {
  const QStringList parts = text.split(QLatin1Char(','));
  if (parts.size() != 4) return std::nullopt;
  std::array<float, 4> values{};
  for (std::size_t i = 0; i < 4; ++i) {
    bool ok = false;
    values[i] = parts[static_cast<qsizetype>(i)].trimmed().toFloat(&ok);
    if (!ok) return std::nullopt;
  }
  if (!(values[0] > 0 && values[1] > 0)) return std::nullopt;
  return Intrinsics{values[0], values[1], values[2], values[3], 0, 0};
}

SourceDialog::SourceDialog(const QString& source, QWidget* parent)
    : QDialog(parent),
      source_(new QLineEdit(source)),
      intrinsics_(new QLineEdit),
      depth_scale_(new QLineEdit),
      start_(numberField(0, 0)),
      stride_(numberField(1, 1)),
      frames_(numberField(0, 0, tr("all"))),
      poses_(new QComboBox),
      object_(new QCheckBox(tr("Scan &one object"))),
      buttons_(new QDialogButtonBox(QDialogButtonBox::Open | QDialogButtonBox::Cancel)) {
  setWindowTitle(tr("Open with options"));
  setMinimumWidth(520);
  intrinsics_->setPlaceholderText(tr("from the recording; or fx, fy, cx, cy in pixels"));
  depth_scale_->setPlaceholderText(tr("from the recording; or units per metre"));
  const auto addPoses = [this](const QString& text, ScanRequest::Poses poses, const QString& help) {
    poses_->addItem(text, static_cast<int>(poses));
    poses_->setItemData(poses_->count() - 1, help, Qt::ToolTipRole);
  };
  addPoses(tr("Automatic"), ScanRequest::Poses::automatic,
           tr("Poses of a device that tracks itself help to track the camera; others are not used."));
  addPoses(tr("Track the camera"), ScanRequest::Poses::tracked, tr("Poses of the recording are not used."));
  addPoses(tr("Use the poses of the recording"), ScanRequest::Poses::given, tr("The camera is not tracked."));

  auto* form = new QFormLayout;
  form->setSpacing(8);
  auto* row = new QHBoxLayout;
  auto* browse_button = new QPushButton(tr("Browse…"));
  connect(browse_button, &QPushButton::clicked, this, &SourceDialog::browse);
  row->addWidget(source_, 1);
  row->addWidget(browse_button);
  form->addRow(tr("Folder or recording"), row);
  form->addRow(tr("&Intrinsics"), intrinsics_);
  form->addRow(tr("&Depth scale"), depth_scale_);
  form->addRow(tr("Camera &poses"), poses_);
  form->addRow(tr("&Skip first frames"), start_);
  form->addRow(tr("&Every n-th frame"), stride_);
  form->addRow(tr("At &most frames"), frames_);
  object_->setToolTip(
      tr("Scan what stands near the middle of the first image alone, on a turntable or in a hand. "
         "The surface below it and the room are left out."));
  form->addRow(QString(), object_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(18, 16, 18, 14);
  layout->setSpacing(14);
  layout->addLayout(form);
  layout->addWidget(buttons_);
  connect(buttons_, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons_, &QDialogButtonBox::rejected, this, &QDialog::reject);
  for (QLineEdit* field : {source_, intrinsics_, depth_scale_}) {
    connect(field, &QLineEdit::textChanged, this, &SourceDialog::validate);
  }
  validate();
}

void SourceDialog::askToContinue(const QString& scan) {
  setWindowTitle(tr("Continue scan %1").arg(scan));
  source_->setPlaceholderText(tr("a recording of the same place, or camera"));
  buttons_->button(QDialogButtonBox::Open)->setText(tr("&Continue scan"));
  object_->setChecked(false);  // a scan of one object is not continued
  object_->hide();
}

QString SourceDialog::source() const { return source_->text().trimmed(); }

SourceOptions SourceDialog::options() const {
  SourceOptions options;
  options.start = start_->value();
  options.stride = stride_->value();
  if (frames_->value() > 0) options.frames = frames_->value();
  options.intrinsics = parseIntrinsics(intrinsics_->text());
  bool ok = false;
  const double scale = depth_scale_->text().toDouble(&ok);
  if (ok && scale > 0) options.depth_scale = scale;
  return options;
}

ScanRequest::Poses SourceDialog::poses() const {
  return static_cast<ScanRequest::Poses>(poses_->currentData().toInt());
}

std::optional<ObjectChoice> SourceDialog::object() const {
  return object_->isChecked() ? std::optional(ObjectChoice{}) : std::nullopt;
}

void SourceDialog::browse() {
  const QString folder = chooseFolder(this, tr("Folder of the recording"), source());
  if (!folder.isEmpty()) source_->setText(folder);
}

void SourceDialog::validate() {
  const bool intrinsics_fine =
      intrinsics_->text().trimmed().isEmpty() || parseIntrinsics(intrinsics_->text()).has_value();
  bool number = false;
  const double scale = depth_scale_->text().toDouble(&number);
  const bool scale_fine = depth_scale_->text().trimmed().isEmpty() || (number && scale > 0);
  buttons_->button(QDialogButtonBox::Open)->setEnabled(!source().isEmpty() && intrinsics_fine && scale_fine);
}

}  // namespace scantrove
