#include "ui/panels/object_filter_bar.h"

#include <QAbstractItemView>
#include <QAction>
#include <QComboBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>
#include <array>
#include <map>
#include <utility>

#include "ui/models/object_filter.h"

namespace scantrove {
namespace {

using Shown = ObjectFilter::Shown;
using Order = ObjectFilter::Order;

constexpr int kCountingInterval_ms = 400;
constexpr int kClassIdRole = Qt::UserRole + 1;

constexpr std::array kShownOfAnyClass{Shown::all,     Shown::named,   Shown::confirmed, Shown::without_name,
                                      Shown::in_view, Shown::in_scan, Shown::changed};

QString shownInWords(Shown shown) {
  switch (shown) {
    case Shown::all:
      return ObjectFilterBar::tr("All");
    case Shown::named:
      return ObjectFilterBar::tr("Named");
    case Shown::confirmed:
      return ObjectFilterBar::tr("Confirmed");
    case Shown::without_name:
      return ObjectFilterBar::tr("Not yet named");
    case Shown::in_view:
      return ObjectFilterBar::tr("In view");
    case Shown::in_scan:
      return ObjectFilterBar::tr("In this scan");
    case Shown::changed:
      return ObjectFilterBar::tr("Changed since confirmed");
    case Shown::of_class:
      break;
  }
  return {};
}

/// Number of objects that each entry shows.
struct EntryCounts {
  std::map<Shown, int> of;
  std::map<std::pair<QString, ClassId>, int> of_class;  ///< by name

  explicit EntryCounts(const ObjectListModel& model) {
    for (const ObjectListModel::Row& row : model.rows()) {
      const ObjectRecord& record = row.record;
      const bool is_named = record.named_by == NamedBy::user;
      ++of[Shown::all];
      ++of[is_named ? Shown::named : Shown::without_name];
      if (record.confirmed) ++of[Shown::confirmed];
      if (model.isInView(record.id)) ++of[Shown::in_view];
      if (model.isInScan(record.id)) ++of[Shown::in_scan];
      if (model.isChanged(record.id)) ++of[Shown::changed];
      ++of_class[{row.class_name, row.class_id}];
    }
  }
};

/// Shows its content only where there is room for it: small screens keep the height for the list.
class FoldingRow : public QWidget {
 public:
  explicit FoldingRow(QWidget* content) : content_(content) { content_->setParent(this); }

  [[nodiscard]] QSize sizeHint() const override { return content_->sizeHint(); }
  [[nodiscard]] QSize minimumSizeHint() const override { return {content_->minimumSizeHint().width(), 0}; }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    QWidget::resizeEvent(event);
    const int full = content_->sizeHint().height();
    content_->setGeometry(0, 0, width(), full);
    content_->setVisible(height() >= full);
  }

 private:
  QWidget* content_;
};

}  // namespace

ObjectFilterBar::ObjectFilterBar(ObjectListModel& model, ObjectFilter& filter, QWidget* parent)
    : QWidget(parent),
      model_(model),
      filter_(filter),
      search_(new QLineEdit),
      shown_(new QComboBox),
      order_(new QComboBox),
      find_(new QAction(tr("&Find object"), this)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(4, 0, 4, 0);
  column->setSpacing(4);
  search_->setObjectName(QStringLiteral("objectSearch"));
  search_->setPlaceholderText(tr("Name or class"));
  search_->setAccessibleName(tr("Search objects"));
  search_->setClearButtonEnabled(true);
  for (QToolButton* button : search_->findChildren<QToolButton*>())
    button->setAccessibleName(tr("Clear the search"));
  search_->installEventFilter(this);
  column->addWidget(search_);
  auto* choices = new QWidget;
  auto* row = new QHBoxLayout(choices);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(4);
  shown_->setAccessibleName(tr("Objects to show"));
  shown_->setToolTip(tr("Which objects the list shows"));
  order_->setAccessibleName(tr("Order of the objects"));
  order_->setToolTip(tr("Order of the list"));
  for (QComboBox* box : {shown_, order_}) {
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(8);
    row->addWidget(box, 1);
  }
  column->addWidget(new FoldingRow(choices));
  for (const auto& [order, text] :
       {std::pair(Order::oldest, tr("Oldest first")), std::pair(Order::newest, tr("Newest first")),
        std::pair(Order::name, tr("Name")), std::pair(Order::object_class, tr("Class")),
        std::pair(Order::views, tr("Most views")), std::pair(Order::size, tr("Largest"))})
    order_->addItem(text, static_cast<int>(order));
  find_->setShortcut(QKeySequence(QStringLiteral("Ctrl+F")));
  find_->setToolTip(tr("Find an object by its name or class (Ctrl+F)"));
  updateEntries();

  connect(search_, &QLineEdit::textChanged, this, [this](const QString& text) {
    filter_.setSearch(text);
    emit changed();
  });
  connect(shown_, &QComboBox::currentIndexChanged, this, &ObjectFilterBar::applyShown);
  connect(order_, &QComboBox::currentIndexChanged, this,
          [this] { filter_.setOrder(static_cast<Order>(order_->currentData().toInt())); });
  counting_.setSingleShot(true);
  counting_.setInterval(kCountingInterval_ms);
  connect(&counting_, &QTimer::timeout, this, &ObjectFilterBar::updateEntries);
  const auto countSoon = [this] {
    if (!counting_.isActive()) counting_.start();
  };
  connect(&model_, &ObjectListModel::updated, this, countSoon);
  connect(&model_, &QAbstractItemModel::modelReset, this, &ObjectFilterBar::updateEntries);
  connect(&model_, &QAbstractItemModel::dataChanged, this, countSoon);
}

void ObjectFilterBar::updateEntries() {
  if (shown_->view()->isVisible()) return counting_.start();  // an open list does not change
  const EntryCounts counts(model_);
  const QSignalBlocker blocker(shown_);
  shown_->clear();
  const auto add = [this](const QString& text, int count, Shown shown, ClassId class_id) {
    shown_->addItem(tr("%1 (%2)").arg(text, QString::number(count)), static_cast<int>(shown));
    shown_->setItemData(shown_->count() - 1, class_id.value, kClassIdRole);
    if (shown == filter_.shown() && class_id == filter_.shownClass())
      shown_->setCurrentIndex(shown_->count() - 1);
  };
  for (const Shown shown : kShownOfAnyClass) {
    const auto found = counts.of.find(shown);
    if (shown == Shown::changed && found == counts.of.end()) continue;  // rare
    add(shownInWords(shown), found == counts.of.end() ? 0 : found->second, shown, {});
  }
  shown_->insertSeparator(shown_->count());
  for (const auto& [entry, count] : counts.of_class)
    add(entry.second ? entry.first : tr("No class"), count, Shown::of_class, entry.second);
  const bool is_gone = static_cast<Shown>(shown_->currentData().toInt()) != filter_.shown() ||
                       ClassId{shown_->currentData(kClassIdRole).toUInt()} != filter_.shownClass();
  if (!is_gone) return;
  // The last object of the class is gone.
  shown_->setCurrentIndex(0);
  applyShown();
}

void ObjectFilterBar::applyShown() {
  filter_.setShown(static_cast<Shown>(shown_->currentData().toInt()),
                   ClassId{shown_->currentData(kClassIdRole).toUInt()});
  emit changed();
}

void ObjectFilterBar::clear() {
  search_->clear();
  shown_->setCurrentIndex(0);
}

bool ObjectFilterBar::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride) {
    // While text is typed, keys without Ctrl or Alt are no shortcuts.
    const Qt::KeyboardModifiers modifiers = static_cast<QKeyEvent*>(event)->modifiers();
    if (modifiers & (Qt::ControlModifier | Qt::AltModifier)) return QWidget::eventFilter(watched, event);
    event->accept();
    return true;
  }
  if (event->type() != QEvent::KeyPress) return QWidget::eventFilter(watched, event);
  switch (static_cast<QKeyEvent*>(event)->key()) {
    case Qt::Key_Escape:
      search_->clear();
      emit listWanted();
      return true;
    case Qt::Key_Return:
    case Qt::Key_Enter:
    case Qt::Key_Down:
      emit listWanted();
      return true;
    default:
      return QWidget::eventFilter(watched, event);
  }
}

}  // namespace scantrove
