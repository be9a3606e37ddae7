#include "ui/panels/camera_dialog.h"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QGuiApplication>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QRegularExpression>
#include <QVBoxLayout>

#include "ui/theme/icon.h"

namespace scantrove {
namespace {

/// Converts plain text to rich text, with text in back quotes as code.
QString withCode(const QString& text) {
  static const QRegularExpression quoted(QStringLiteral("`([^`]+)`"));
  return text.toHtmlEscaped().replace(quoted, QStringLiteral("<code>\\1</code>"));
}

}  // namespace

CameraDialog::CameraDialog(Lister lister, QWidget* parent)
    : QDialog(parent),
      lister_(std::move(lister)),
      list_(new QListWidget),
      advice_(new QLabel),
      object_(new QCheckBox(tr("Scan &one object"))),
      open_(nullptr) {
  setWindowTitle(tr("Choose a camera"));
  setMinimumSize(460, 320);
  list_->setAccessibleName(tr("Cameras"));
  list_->setIconSize({24, 24});
  list_->setSpacing(2);
  advice_->setObjectName(QStringLiteral("cameraAdvice"));
  advice_->setWordWrap(true);
  advice_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  object_->setToolTip(
      tr("Scan what stands near the middle of the first image alone, on a turntable or in a hand. "
         "The surface below it and the room are left out."));
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  open_ = buttons->addButton(tr("&Start scan"), QDialogButtonBox::AcceptRole);
  open_->setProperty("primary", true);
  open_->setDefault(true);
  open_->setObjectName(QStringLiteral("startCamera"));
  QPushButton* again = buttons->addButton(tr("&Refresh"), QDialogButtonBox::ActionRole);
  connect(again, &QPushButton::clicked, this, &CameraDialog::refresh);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(list_, &QListWidget::itemSelectionChanged, this,
          [this] { open_->setEnabled(!source().isEmpty()); });
  connect(list_, &QListWidget::itemActivated, this, [this](QListWidgetItem* item) {
    item->setSelected(true);  // with the keyboard it may be the current one only
    accept();
  });
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(16, 16, 16, 14);
  layout->setSpacing(10);
  layout->addWidget(advice_);
  layout->addWidget(list_, 1);
  layout->addWidget(object_);
  layout->addWidget(buttons);
  refresh();
}

QString CameraDialog::source() const {
  const QList<QListWidgetItem*> chosen = list_->selectedItems();
  return chosen.isEmpty() ? QString() : chosen.front()->data(Qt::UserRole).toString();
}

std::optional<ObjectChoice> CameraDialog::object() const {
  return object_->isChecked() ? std::optional(ObjectChoice{}) : std::nullopt;
}

void CameraDialog::refresh() {
  QGuiApplication::setOverrideCursor(Qt::WaitCursor);
  const Result<std::vector<CameraInfo>> cameras = lister_();
  QGuiApplication::restoreOverrideCursor();
  list_->clear();
  const auto add = [this](const QString& title, const QString& uri) {
    auto* item = new QListWidgetItem(icon(QStringLiteral("camera")), title, list_);
    item->setData(Qt::UserRole, QStringLiteral("camera:") + uri);
    item->setToolTip(uri);
  };
  if (cameras) {
    for (const CameraInfo& camera : *cameras) {
      add(QString::fromStdString(camera.vendor.empty() ? camera.name : camera.vendor + " " + camera.name),
          QString::fromStdString(camera.uri));
    }
  }
  if (!cameras) {
    advice_->setText(QString::fromStdString(cameras.error().message()));
  } else if (cameras->empty()) {
    advice_->setText(
        tr("<b>No depth camera was found.</b><br>%1").arg(withCode(QString::fromStdString(cameraAdvice()))));
  } else {
    advice_->setText(tr("Depth cameras on this computer:"));
  }
  add(tr("Virtual test camera with a test pattern"), QStringLiteral("Dummy"));
  // A scan of the test pattern helps nobody who did not ask for it.
  if (list_->count() > 1) list_->setCurrentRow(0);
  open_->setEnabled(!source().isEmpty());
}

}  // namespace scantrove
