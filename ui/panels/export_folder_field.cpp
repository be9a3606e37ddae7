#include "ui/panels/export_folder_field.h"

#include <QFileInfo>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPushButton>
#include <QSettings>
#include <QStandardPaths>

#include "ui/panels/file_dialogs.h"

namespace scantrove {
namespace {

const QString kExportFolderKey = QStringLiteral("export/folder");

}  // namespace

ExportFolderField::ExportFolderField(const QString& name, QWidget* parent)
    : QWidget(parent), name_(name), field_(new QLineEdit) {
  field_->setAccessibleName(tr("Folder"));
  field_->setToolTip(
      tr("A new or an empty folder, or that of an earlier data set of the same format, which is "
         "replaced if nobody has changed it"));
  auto* choose_button = new QPushButton(tr("&Choose…"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(field_, 1);
  row->addWidget(choose_button);
  setFocusProxy(field_);
  connect(choose_button, &QPushButton::clicked, this, &ExportFolderField::choose);
  connect(field_, &QLineEdit::textEdited, this, [this](const QString& text) { is_typed_ = !text.isEmpty(); });
}

QString ExportFolderField::folder() const { return field_->text(); }

void ExportFolderField::setFormat(const QString& format) {
  format_ = format;
  propose();
}

void ExportFolderField::setName(const QString& name) {
  name_ = name;
  propose();
}

void ExportFolderField::choose() {
  const QString parent = chooseFolder(this, tr("Folder of the data set"), QFileInfo(folder()).path());
  if (parent.isEmpty()) return;
  QSettings().setValue(kExportFolderKey, parent);
  is_typed_ = false;
  propose();
}

void ExportFolderField::propose() {
  if (is_typed_) return;
  const QString documents = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  const QString parent = QSettings().value(kExportFolderKey, documents).toString();
  const QString base = parent + QLatin1Char('/') + name_ + QLatin1Char('-') + format_;
  QString proposed = base;
  for (int i = 2; QFileInfo::exists(proposed); ++i) proposed = base + QLatin1Char('-') + QString::number(i);
  field_->setText(proposed);
}

}  // namespace scantrove
