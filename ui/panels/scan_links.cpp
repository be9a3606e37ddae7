#include "ui/panels/scan_links.h"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/models/plain_text.h"

namespace scantrove {

ScanLinks::ScanLinks(QWidget* parent) : QWidget(parent), rows_(new QVBoxLayout), note_(new QLabel) {
  setAccessibleName(tr("Scans with the object"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  rows_->setSpacing(2);
  column->addLayout(rows_);
  note_->setWordWrap(true);
  note_->setProperty("muted", true);
  note_->setText(tr("No saved scan of this project has it."));
  column->addWidget(note_);
}

void ScanLinks::setEntries(const std::vector<Entry>& entries) {
  while (QLayoutItem* item = rows_->takeAt(0)) {
    item->widget()->hide();
    item->widget()->deleteLater();
    delete item;
  }
  for (const Entry& entry : entries) {
    QString title = entry.title;
    title.replace(QLatin1Char('&'), QStringLiteral("&&"));
    auto* link = new QPushButton(QStringLiteral("%1 · %2").arg(title, entry.details));
    link->setObjectName(QStringLiteral("scanOfObject"));
    link->setFlat(true);
    link->setAutoDefault(false);
    link->setStyleSheet(QStringLiteral("text-align: left"));
    link->setEnabled(!entry.is_open);
    link->setToolTip(entry.is_open ? tr("This scan is open") : plainTip(tr("Open %1").arg(entry.folder)));
    connect(link, &QPushButton::clicked, this, [this, folder = entry.folder] { emit requested(folder); });
    rows_->addWidget(link);
  }
  note_->setVisible(entries.empty());
}

}  // namespace scantrove
