#include "ui/panels/object_head.h"

#include <QFocusEvent>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPainter>
#include <QPixmap>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/models/catalogue_editor.h"
#include "ui/models/object_list_model.h"
#include "ui/panels/coverage_ring.h"
#include "ui/panels/same_name_choice.h"
#include "ui/theme/theme.h"

namespace scantrove {
namespace {

constexpr int kLongestPageName = 120;
constexpr int kPageRing_px = 36;

QString stateInWords(const ObjectRecord& record) {
  if (record.confirmed) return scantrove::ObjectHead::tr("Confirmed");
  return record.named_by == NamedBy::user ? scantrove::ObjectHead::tr("Named, not confirmed")
                                          : scantrove::ObjectHead::tr("New, without a name");
}

}  // namespace

ObjectHead::ObjectHead(CatalogueEditor& editor, ObjectListModel& model, QWidget* parent)
    : QWidget(parent),
      editor_(editor),
      model_(model),
      renamer_(editor),
      name_(new QLineEdit),
      choice_(new SameNameChoice),
      class_(new QLabel),
      state_(new QLabel),
      size_(new QLabel),
      ring_(new QLabel),
      sides_(new QLabel),
      confirm_(new QPushButton) {
  name_->setObjectName(QStringLiteral("pageName"));
  name_->setAccessibleName(tr("Name of the object"));
  name_->setToolTip(tr("The name, or class/name"));
  name_->setMaxLength(kLongestPageName);
  name_->installEventFilter(this);
  QFont large = name_->font();
  large.setPointSizeF(large.pointSizeF() * 1.3);
  large.setWeight(QFont::DemiBold);
  name_->setFont(large);
  confirm_->setAutoDefault(false);
  for (QLabel* label : {class_, state_, size_, sides_}) label->setTextFormat(Qt::PlainText);
  for (QLabel* label : {class_, size_, sides_}) label->setProperty("muted", true);
  sides_->setWordWrap(true);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(name_);
  column->addWidget(choice_);
  column->addWidget(class_);
  auto* states = new QHBoxLayout;
  states->addWidget(state_, 1);
  states->addWidget(confirm_);
  column->addLayout(states);
  column->addWidget(size_);
  auto* seen = new QHBoxLayout;
  seen->addWidget(ring_);
  seen->addWidget(sides_, 1);
  column->addLayout(seen);
  connect(name_, &QLineEdit::textEdited, this, &ObjectHead::showChoice);
  connect(choice_, &SameNameChoice::answered, this, &ObjectHead::finish);
  connect(choice_, &SameNameChoice::cancelled, this, &ObjectHead::cancel);
  connect(choice_, &SameNameChoice::left, this, [this] {
    if (!name_->hasFocus()) finish();
  });
  connect(confirm_, &QPushButton::clicked, this, [this] {
    const ObjectRecord* const record = model_.record(object_);
    if (record != nullptr) editor_.setConfirmed({object_}, !record->confirmed);
  });
  showSides(std::nullopt, {});
}

void ObjectHead::showObject(ObjectId object) {
  const ObjectRecord* const record = model_.record(object);
  if (record == nullptr) return;
  const QString name = QString::fromStdString(record->name);
  if (object != object_) renamer_.begin(object);
  if (object != object_ || !name_->isModified()) name_->setText(name);
  object_ = object;
  name_before_ = name;
  const QModelIndex row = model_.indexOf(object);
  const QString class_name = row.data(ObjectListModel::ClassNameRole).toString();
  class_->setText(class_name.isEmpty() ? tr("No class") : tr("Class: %1").arg(class_name));
  state_->setText(stateInWords(*record));
  size_->setText(row.data(ObjectListModel::SizeTextRole).toString());
  confirm_->setText(record->confirmed ? tr("Unconfirm") : tr("Confirm"));
}

void ObjectHead::showSides(const std::optional<SeenSides>& sides, const QString& text) {
  sides_->setText(text);
  ring_->setVisible(sides.has_value());
  sides_->setVisible(sides.has_value());
  if (!sides) return;
  QPixmap picture(QSize(kPageRing_px, kPageRing_px) * devicePixelRatioF());
  picture.setDevicePixelRatio(devicePixelRatioF());
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  paintCoverageRing(&painter, QRectF(1, 1, kPageRing_px - 2, kPageRing_px - 2), *sides,
                    Theme::instance().colors());
  painter.end();
  ring_->setPixmap(picture);
}

QString ObjectHead::state() const { return state_->text(); }

bool ObjectHead::finish(TypedName::Answer answer) {
  if (!name_->isModified() || !object_) return true;
  const QString text = name_->text().trimmed();
  if (text.isEmpty() || text == name_before_) {
    cancel();
    return true;
  }
  // The field is read anew when the name is stored; a name that cannot be stored stays in it.
  name_->setModified(false);
  if (!renamer_.apply(object_, text, answer)) {
    name_->setModified(true);
    return false;
  }
  choice_->dismiss();
  showObject(object_);
  return true;
}

void ObjectHead::cancel() {
  const bool had_focus = choice_->holdsFocus();
  choice_->dismiss();
  name_->setText(name_before_);
  if (had_focus) name_->setFocus(Qt::OtherFocusReason);
}

void ObjectHead::showChoice(const QString& text) {
  renamer_.begin(object_);
  const std::optional<TypedName> typed = renamer_.check(text);
  choice_->ask(typed && text.trimmed() != name_before_ ? *typed : TypedName());
  if (typed && text.trimmed() != name_before_) {
    class_->setText(typed->classInWords());
  } else {
    const QString class_name = model_.indexOf(object_).data(ObjectListModel::ClassNameRole).toString();
    class_->setText(class_name.isEmpty() ? tr("No class") : tr("Class: %1").arg(class_name));
  }
}

bool ObjectHead::handleKey(const QKeyEvent& key) {
  switch (key.key()) {
    case Qt::Key_Return:
    case Qt::Key_Enter: {
      const bool is_same = choice_->isAsking() && key.modifiers().testFlag(Qt::ShiftModifier);
      finish(is_same ? TypedName::Answer::same : TypedName::Answer::another);
      return true;
    }
    case Qt::Key_Escape:
      if (!name_->isModified()) return false;  // closes the page
      cancel();
      return true;
    case Qt::Key_Tab:
      if (!choice_->isAsking()) return false;
      choice_->enter();
      return true;
    default:
      return false;
  }
}

bool ObjectHead::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::KeyPress) return handleKey(*static_cast<QKeyEvent*>(event));
  if (event->type() == QEvent::FocusOut) {
    const Qt::FocusReason reason = static_cast<QFocusEvent*>(event)->reason();
    const bool is_left = reason != Qt::ActiveWindowFocusReason && reason != Qt::PopupFocusReason;
    if (is_left && !choice_->holdsFocus()) finish();
  }
  return QWidget::eventFilter(watched, event);
}

}  // namespace scantrove
