#include "ui/panels/object_panel.h"

#include <QAction>
#include <QHBoxLayout>
#include <QItemSelectionModel>
#include <QLabel>
#include <QListView>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/models/object_list_model.h"
#include "ui/panels/empty_note.h"
#include "ui/panels/object_delegate.h"
#include "ui/panels/views_strip.h"
#include "ui/theme/icon.h"

namespace scantrove {

ObjectPanel::ObjectPanel(CatalogueEditor& editor, ObjectListModel& model, QWidget* parent)
    : QWidget(parent),
      editor_(editor),
      model_(model),
      pages_(new QStackedWidget),
      list_(new QListView),
      count_(new QLabel) {
  list_->setModel(&model_);
  list_->setItemDelegate(new ObjectDelegate(list_));
  list_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  list_->setEditTriggers(QAbstractItemView::DoubleClicked);
  list_->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
  list_->setUniformItemSizes(true);
  list_->setMouseTracking(true);
  list_->setAccessibleName(tr("Objects"));
  list_->setObjectName(QStringLiteral("objectList"));
  list_->setContextMenuPolicy(Qt::ActionsContextMenu);
  makeActions();

  pages_->addWidget(list_);
  pages_->addWidget(
      new EmptyNote(QStringLiteral("cube"), tr("No objects yet"),
                    tr("What a scan discovers appears here,\nwith its views, to name and confirm.")));

  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 0, 4, 6);
  layout->setSpacing(4);
  count_->setContentsMargins(8, 0, 0, 2);
  count_->setProperty("muted", true);
  layout->addWidget(count_);
  layout->addWidget(pages_, 1);
  layout->addWidget(makeDetails());

  connect(&model_, &QAbstractItemModel::rowsInserted, this, &ObjectPanel::updateCounts);
  connect(&model_, &QAbstractItemModel::rowsRemoved, this, &ObjectPanel::updateCounts);
  connect(&model_, &QAbstractItemModel::dataChanged, this, [this] {
    updateCounts();
    updateSelection();
  });
  connect(list_->selectionModel(), &QItemSelectionModel::selectionChanged, this,
          &ObjectPanel::updateSelection);
  updateCounts();
  updateSelection();
}

void ObjectPanel::makeActions() {
  const auto make = [this](const char* picture, const QString& text, const QString& help,
                           const QList<QKeySequence>& keys, auto&& slot) {
    auto* action = new QAction(icon(QString::fromLatin1(picture)), text, this);
    action->setToolTip(QStringLiteral("%1 (%2)").arg(help, keys.first().toString(QKeySequence::NativeText)));
    action->setStatusTip(help);
    action->setShortcuts(keys);
    // Only with the focus in the list: Return must end the editing of a name, Del delete a letter.
    action->setShortcutContext(Qt::WidgetShortcut);
    connect(action, &QAction::triggered, this, slot);
    list_->addAction(action);
    return action;
  };
  actions_.rename = make("rename", tr("&Rename"), tr("Give the object a name"), {QKeySequence(Qt::Key_F2)},
                         [this] { editName(); });
  actions_.confirm =
      make("confirm", tr("&Confirm"), tr("Say that this is an object, and that its name is right"),
           {QKeySequence(Qt::Key_Return), QKeySequence(Qt::Key_Enter)}, [this] { toggleConfirmed(); });
  actions_.merge = make("merge", tr("&Merge"), tr("The selected objects are one and the same"),
                        {QKeySequence(Qt::Key_M)}, [this] { editor_.merge(selection()); });
  actions_.remove = make("delete", tr("&Delete"), tr("Remove the object from the catalogue (can be undone)"),
                         {QKeySequence(Qt::Key_Delete)}, [this] { editor_.remove(selection()); });
}

QWidget* ObjectPanel::makeDetails() {
  details_ = new QWidget;
  auto* layout = new QVBoxLayout(details_);
  layout->setContentsMargins(6, 4, 6, 0);
  layout->setSpacing(4);
  auto* row = new QHBoxLayout;
  row->setSpacing(0);
  selected_name_ = new QLabel;
  QFont bold = selected_name_->font();
  bold.setWeight(QFont::DemiBold);
  selected_name_->setFont(bold);
  row->addWidget(selected_name_, 1);
  for (QAction* action : {actions_.rename, actions_.confirm, actions_.merge, actions_.remove}) {
    auto* button = new QToolButton;
    button->setDefaultAction(action);
    button->setIconSize({18, 18});
    button->setAccessibleName(action->text().remove(QLatin1Char('&')));
    row->addWidget(button);
  }
  layout->addLayout(row);
  strip_ = new ViewsStrip;
  layout->addWidget(strip_);
  return details_;
}

std::vector<ObjectId> ObjectPanel::selection() const {
  QModelIndexList rows = list_->selectionModel()->selectedIndexes();
  // Oldest last in the list = lowest id first here: the older object is the one that others are merged into.
  std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.row() > b.row(); });
  std::vector<ObjectId> objects;
  for (const QModelIndex& row : rows) objects.push_back(model_.objectAt(row));
  return objects;
}

void ObjectPanel::selectFirst() { list_->setCurrentIndex(model_.index(0)); }

void ObjectPanel::editName() {
  const QModelIndex index = list_->currentIndex();
  if (index.isValid()) list_->edit(index);
}

void ObjectPanel::toggleConfirmed() {
  for (const ObjectId object : selection()) {
    const ObjectRecord* record = model_.record(object);
    if (record != nullptr) editor_.setConfirmed(object, !record->confirmed);
  }
}

void ObjectPanel::updateCounts() {
  const int all = model_.rowCount();
  pages_->setCurrentIndex(all == 0 ? 1 : 0);
  count_->setText(all == 0 ? QString()
                           : tr("%1 in the catalogue, %2 confirmed").arg(all).arg(model_.confirmedCount()));
  count_->setVisible(all > 0);
}

void ObjectPanel::updateSelection() {
  const std::vector<ObjectId> chosen = selection();
  const bool any = !chosen.empty();
  const ObjectRecord* record = chosen.size() == 1 ? model_.record(chosen[0]) : nullptr;
  actions_.rename->setEnabled(record != nullptr);
  actions_.confirm->setEnabled(any);
  actions_.remove->setEnabled(any);
  actions_.merge->setEnabled(chosen.size() > 1);
  actions_.confirm->setText(record != nullptr && record->confirmed ? tr("Take back &confirmation")
                                                                   : tr("&Confirm"));
  details_->setVisible(any);
  strip_->setVisible(record != nullptr);
  selected_name_->setText(record != nullptr ? QString::fromStdString(record->name)
                                            : tr("%1 objects selected").arg(chosen.size()));
  const ObjectId object = record != nullptr ? record->id : ObjectId{};
  const int views = record != nullptr ? record->views : -1;
  if (object == shown_ && views == shown_views_) return;
  shown_ = object;
  shown_views_ = views;
  std::vector<QImage> pictures;
  if (object) {
    for (const ObjectView& view : editor_.views(object)) pictures.push_back(viewPicture(view));
    std::reverse(pictures.begin(), pictures.end());
  }
  strip_->setViews(std::move(pictures));
}

}  // namespace scantrove
