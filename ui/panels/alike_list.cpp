#include "ui/panels/alike_list.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>

#include "ui/models/plain_text.h"
#include "ui/panels/elided_label.h"

namespace scantrove {
namespace {

constexpr int kAlikePicture_px = 56;

}  // namespace

AlikeList::AlikeList(QWidget* parent) : QWidget(parent), rows_(new QVBoxLayout), note_(new QLabel) {
  setAccessibleName(tr("Perhaps the same object"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addLayout(rows_);
  note_->setWordWrap(true);
  note_->setProperty("muted", true);
  column->addWidget(note_);
}

void AlikeList::clear() {
  while (QLayoutItem* item = rows_->takeAt(0)) {
    // Later: it may be the row whose button was pressed.
    item->widget()->hide();
    item->widget()->deleteLater();
    delete item;
  }
}

void AlikeList::setSearching() {
  clear();
  note_->setText(tr("Comparing with the other objects…"));
  note_->show();
}

void AlikeList::setEntries(const std::vector<Entry>& entries) {
  clear();
  for (const Entry& entry : entries) rows_->addWidget(makeRow(entry));
  note_->setText(tr("No other object of the catalogue looks like it."));
  note_->setVisible(entries.empty());
}

QWidget* AlikeList::makeRow(const Entry& entry) {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* picture = new QToolButton;
  picture->setAutoRaise(true);
  picture->setIcon(QIcon(QPixmap::fromImage(entry.picture)));
  picture->setIconSize({kAlikePicture_px, kAlikePicture_px});
  const QString page = tr("Show the page of “%1”").arg(entry.name);
  picture->setToolTip(plainTip(page));
  picture->setAccessibleName(page);
  connect(picture, &QToolButton::clicked, this, [this, object = entry.object] { emit shown(object); });
  layout->addWidget(picture);
  auto* texts = new QVBoxLayout;
  auto* name = new ElidedLabel;
  name->setFullText(entry.name);
  texts->addWidget(name);
  auto* how = new QLabel(entry.is_very_alike ? tr("very alike") : tr("alike"));
  how->setProperty("muted", true);
  how->setToolTip(entry.is_very_alike
                      ? tr("A scan would take the one for the other.")
                      : tr("Their views resemble each other more than those of most objects."));
  texts->addWidget(how);
  layout->addLayout(texts, 1);
  const auto add = [this, layout, &entry](const QString& text, const QString& help,
                                          const char* name_of_button, auto signal) {
    auto* button = new QPushButton(text);
    button->setObjectName(QLatin1String(name_of_button));
    button->setToolTip(help);
    button->setAccessibleName(QStringLiteral("%1: %2").arg(entry.name, text));
    button->setAutoDefault(false);
    connect(button, &QPushButton::clicked, this,
            [this, signal, object = entry.object] { emit(this->*signal)(object); });
    layout->addWidget(button);
  };
  add(tr("The same object"), tr("Merge the two; a name that you gave stays"), "sameObject", &AlikeList::same);
  add(tr("Different"), tr("Do not suggest this one again in this catalogue"), "differentObject",
      &AlikeList::different);
  return row;
}

}  // namespace scantrove
