#include "ui/panels/region_name_editor.h"

#include <QCompleter>
#include <QEvent>
#include <QFocusEvent>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QStringListModel>
#include <QVBoxLayout>
#include <algorithm>

namespace scantrove {
namespace {
constexpr int kLongestRegionName = 120;
constexpr int kNameEditorWidth = 260;
}  // namespace

RegionNameEditor::RegionNameEditor(QWidget* parent)
    : QFrame(parent), about_(new QLabel), field_(new QLineEdit), known_(new QStringListModel(this)) {
  setObjectName(QStringLiteral("regionNameEditor"));
  setFrameShape(QFrame::StyledPanel);
  setAutoFillBackground(true);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(10, 8, 10, 8);
  column->setSpacing(4);
  about_->setProperty("muted", true);
  column->addWidget(about_);
  field_->setObjectName(QStringLiteral("regionNameField"));
  field_->setMaxLength(kLongestRegionName);
  field_->setMinimumWidth(kNameEditorWidth);
  field_->setPlaceholderText(tr("Name, or category/name"));
  field_->setAccessibleName(tr("Name of the region"));
  auto* completer = new QCompleter(known_, this);
  completer->setCaseSensitivity(Qt::CaseInsensitive);
  completer->setFilterMode(Qt::MatchContains);
  field_->setCompleter(completer);
  column->addWidget(field_);
  field_->installEventFilter(this);
  connect(field_, &QLineEdit::returnPressed, this, &RegionNameEditor::finish);
  hide();
}

void RegionNameEditor::begin(const QPoint& on_screen, const QString& text, const QStringList& known,
                             const QString& about) {
  if (isOpen()) finish();
  known_->setStringList(known);
  about_->setText(about);
  before_ = text;
  field_->setText(text);
  field_->selectAll();
  adjustSize();
  const QPoint requested = parentWidget()->mapFromGlobal(on_screen) + QPoint(12, 10);
  const QSize room = parentWidget()->size();
  move(std::clamp(requested.x(), 0, std::max(0, room.width() - width())),
       std::clamp(requested.y(), 0, std::max(0, room.height() - height())));
  show();
  raise();
  field_->setFocus(Qt::OtherFocusReason);
}

void RegionNameEditor::finish() {
  if (!isOpen()) return;
  const QString text = field_->text().trimmed();
  hide();
  if (text != before_) {
    const auto slash = text.indexOf(QLatin1Char('/'));
    const bool has_category = slash > 0 && slash + 1 < text.size();
    emit named(has_category ? text.mid(slash + 1).trimmed() : text,
               has_category ? text.left(slash).trimmed() : QString());
  }
  emit closed();
}

void RegionNameEditor::cancel() {
  hide();
  emit closed();
}

bool RegionNameEditor::eventFilter(QObject* watched, QEvent* event) {
  // While a name is typed, keys are not shortcuts.
  if (event->type() == QEvent::ShortcutOverride) {
    event->accept();
    return true;
  }
  if (event->type() == QEvent::KeyPress && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
    cancel();
    return true;
  }
  if (event->type() == QEvent::FocusOut && isOpen()) {
    const Qt::FocusReason reason = static_cast<QFocusEvent*>(event)->reason();
    if (reason != Qt::PopupFocusReason && reason != Qt::ActiveWindowFocusReason) finish();
  }
  return QFrame::eventFilter(watched, event);
}

}  // namespace scantrove
