#include "ui/panels/saved_scans_panel.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QImageReader>
#include <QLabel>
#include <QMenu>
#include <QShortcut>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/panels/elided_label.h"
#include "ui/theme/icon.h"

namespace scantrove {
namespace {

constexpr std::size_t kMaxSavedScans = 60;
constexpr int kMaxColumns = 2;
/// Below this, one card needs the whole width for its texts.
constexpr int kLeastWidthOfTwo_px = 640;

QPixmap pictureOf(const SavedScanEntry& scan) {
  const QImage image = scan.thumbnail.isNull() ? readScanPicture(scan.picture) : scan.thumbnail;
  if (image.isNull()) return icon(QStringLiteral("clock")).pixmap(32, 32);
  return QPixmap::fromImage(image);
}

}  // namespace

QImage readScanPicture(const QString& file) {
  if (file.isEmpty()) return {};
  QImageReader reader(file);
  reader.setScaledSize(reader.size().scaled(kScanPicture, Qt::KeepAspectRatioByExpanding));
  const QImage image = reader.read();
  return image.isNull() ? image : image.copy(QRect(QPoint(), kScanPicture));
}

SavedScansPanel::SavedScansPanel(QWidget* parent)
    : QWidget(parent), cards_(new QGridLayout), more_(new QLabel) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 14, 0, 0);
  column->setSpacing(6);
  auto* title = new QLabel(tr("Saved scans"));
  QFont bold = title->font();
  bold.setWeight(QFont::DemiBold);
  title->setFont(bold);
  column->addWidget(title);
  cards_->setSpacing(8);
  column->addLayout(cards_);
  more_->setProperty("muted", true);
  column->addWidget(more_);
  setScans({});
}

void SavedScansPanel::setScans(const std::vector<SavedScanEntry>& scans) {
  while (QLayoutItem* item = cards_->takeAt(0)) {
    item->widget()->deleteLater();
    delete item;
  }
  const std::size_t shown = std::min(scans.size(), kMaxSavedScans);
  std::vector<QWidget*> cards;
  for (std::size_t i = 0; i < shown; ++i) cards.push_back(makeCard(scans[i]));
  arrange(cards);
  more_->setText(tr("and %n more: File > Open scan", nullptr, static_cast<int>(scans.size() - shown)));
  more_->setVisible(scans.size() > shown);
  setVisible(!scans.empty());
}

void SavedScansPanel::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  const int columns = width() < kLeastWidthOfTwo_px ? 1 : kMaxColumns;
  if (columns == columns_) return;
  columns_ = columns;
  std::vector<QWidget*> cards;
  while (QLayoutItem* item = cards_->takeAt(0)) {
    cards.push_back(item->widget());
    delete item;
  }
  arrange(cards);
}

void SavedScansPanel::arrange(const std::vector<QWidget*>& cards) {
  for (std::size_t i = 0; i < cards.size(); ++i) {
    const int index = static_cast<int>(i);
    cards_->addWidget(cards[i], index / columns_, index % columns_);
  }
  for (int c = 0; c < kMaxColumns; ++c) cards_->setColumnStretch(c, c < columns_ ? 1 : 0);
}

QWidget* SavedScansPanel::makeCard(const SavedScanEntry& scan) {
  auto* card = new QToolButton;
  card->setObjectName(QStringLiteral("startCard"));
  card->setAccessibleName(scan.title);
  card->setAccessibleDescription(scan.details);
  // The tooltip shows the full text of elided lines.
  card->setToolTip(QStringLiteral("<b>%1</b><br>%2<br>%3")
                       .arg(scan.title.toHtmlEscaped(),
                            scan.details.toHtmlEscaped().replace(QLatin1Char('\n'), QStringLiteral("<br>")),
                            scan.folder.toHtmlEscaped()));
  card->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  card->setCursor(Qt::PointingHandCursor);
  auto* row = new QHBoxLayout(card);
  row->setContentsMargins(8, 8, 8, 8);
  row->setSpacing(12);
  auto* picture = new QLabel;
  picture->setFixedSize(kScanPicture);
  picture->setAlignment(Qt::AlignCenter);
  picture->setPixmap(pictureOf(scan));
  row->addWidget(picture);
  auto* texts = new QVBoxLayout;
  texts->setSpacing(2);
  texts->addStretch();
  const auto addLine = [texts](const QString& text, Qt::TextElideMode mode) {
    auto* line = new ElidedLabel;
    line->setElideMode(mode);
    line->setFullText(text);
    texts->addWidget(line);
    return line;
  };
  ElidedLabel* heading = addLine(scan.title, Qt::ElideMiddle);
  QFont bold = heading->font();
  bold.setWeight(QFont::DemiBold);
  heading->setFont(bold);
  for (const QString& details : scan.details.split(QLatin1Char('\n'), Qt::SkipEmptyParts))
    addLine(details, Qt::ElideRight)->setProperty("muted", true);
  texts->addStretch();
  row->addLayout(texts, 1);
  // Height for all lines in the current font.
  card->setFixedHeight(std::max(kScanPicture.height() + 16, row->minimumSize().height()));
  for (QLabel* label : card->findChildren<QLabel*>()) label->setAttribute(Qt::WA_TransparentForMouseEvents);
  connect(card, &QToolButton::clicked, this, [this, folder = scan.folder] { emit chosen(folder); });
  const auto remove = [this, folder = scan.folder] { emit deleteRequested(folder); };
  // An action of the card itself would become its menu.
  auto* key = new QShortcut(QKeySequence(Qt::Key_Delete), card, nullptr, nullptr, Qt::WidgetShortcut);
  connect(key, &QShortcut::activated, this, remove);
  QMenu* menu = makeMenu(scan, card);
  menu->addSeparator();
  menu->addAction(icon(QStringLiteral("delete")), tr("&Delete (can be undone)"), this, remove);
  auto* more = new QToolButton;
  more->setObjectName(QStringLiteral("scanActions"));
  more->setText(QStringLiteral("⋯"));
  more->setAutoRaise(true);
  more->setToolTip(tr("Continue, refine, export or delete this scan"));
  more->setAccessibleName(tr("Actions of %1").arg(scan.title));
  more->setPopupMode(QToolButton::InstantPopup);
  more->setMenu(menu);
  more->setStyleSheet(QStringLiteral("QToolButton::menu-indicator { image: none; }"));
  row->addWidget(more);
  card->setContextMenuPolicy(Qt::CustomContextMenu);
  connect(card, &QWidget::customContextMenuRequested, menu,
          [card, menu](const QPoint& at) { menu->popup(card->mapToGlobal(at)); });
  return card;
}

QMenu* SavedScansPanel::makeMenu(const SavedScanEntry& scan, QWidget* card) {
  auto* menu = new QMenu(card);
  menu->setToolTipsVisible(true);
  const auto add = [&](const char* picture, const QString& text, const QString& help, auto action) {
    QAction* entry = menu->addAction(icon(QString::fromLatin1(picture)), text, this, action);
    entry->setToolTip(help);
    entry->setEnabled(scan.can_be_opened);
    return entry;
  };
  const auto request = [this, folder = scan.folder](SavedScanAction action) {
    return [this, folder, action] { emit actionRequested(folder, action); };
  };
  add("clock", tr("&Open"), tr("Label and review this scan"),
      [this, folder = scan.folder] { emit chosen(folder); });
  add("camera", tr("&Continue scan…"), tr("Add frames: the camera finds its place in the map again"),
      request(SavedScanAction::resume));
  add("refine", tr("&Refine objects"), tr("Do the refinement that this scan did not get"),
      request(SavedScanAction::refine))
      ->setEnabled(scan.can_be_opened && scan.can_be_refined);
  add("image", tr("&Export data set…"), tr("Open this scan and export it"),
      request(SavedScanAction::export_data));
  return menu;
}

}  // namespace scantrove
