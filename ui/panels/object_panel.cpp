#include "ui/panels/object_panel.h"

#include <QAction>
#include <QApplication>
#include <QHBoxLayout>
#include <QItemSelectionModel>
#include <QLabel>
#include <QMenu>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "core/project/project.h"
#include "ui/models/object_filter.h"
#include "ui/models/object_list_model.h"
#include "ui/models/plain_text.h"
#include "ui/panels/elided_label.h"
#include "ui/panels/empty_note.h"
#include "ui/panels/object_filter_bar.h"
#include "ui/panels/object_list_view.h"
#include "ui/panels/views_strip.h"
#include "ui/theme/icon.h"

namespace scantrove {

ObjectPanel::ObjectPanel(CatalogueEditor& editor, ObjectListModel& model, QWidget* parent)
    : QWidget(parent),
      editor_(editor),
      model_(model),
      pages_(new QStackedWidget),
      list_(new ObjectListView(editor, model)),
      menu_(new QMenu(this)),
      filter_bar_(new ObjectFilterBar(model, list_->filter())) {
  makeActions();
  list_->setContextMenuPolicy(Qt::CustomContextMenu);
  menu_->addActions({actions_.page, actions_.rename, actions_.confirm, actions_.merge, actions_.remove});
  connect(list_, &QWidget::customContextMenuRequested, this,
          [this](const QPoint& place) { menu_->popup(list_->viewport()->mapToGlobal(place)); });
  connect(menu_, &QMenu::aboutToHide, this, &ObjectPanel::updateActions, Qt::QueuedConnection);

  pages_->addWidget(list_);
  pages_->addWidget(new EmptyNote(
      QStringLiteral("cube"), tr("No objects yet"),
      tr("Objects that a scan discovers appear here,\nwith their views, to name and confirm.")));
  pages_->addWidget(new EmptyNote(QStringLiteral("cube"), tr("No object matches"),
                                  tr("The search or the filter hides all objects.\nEscape in the search "
                                     "field clears it.")));

  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 0, 4, 6);
  layout->setSpacing(4);
  catalogue_ = new ElidedLabel;
  catalogue_->setObjectName(QStringLiteral("catalogueName"));
  catalogue_->setContentsMargins(8, 0, 4, 0);
  layout->addWidget(catalogue_);
  layout->addWidget(makeHead());
  layout->addWidget(filter_bar_);
  pages_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Ignored);  // the choices above fold last
  layout->addWidget(pages_, 1);
  layout->addWidget(makeDetails());

  const auto update = [this] {
    updateCounts();
    updateSelection();
  };
  connect(&editor_, &CatalogueEditor::opened, this, &ObjectPanel::updateCatalogue);
  updateCatalogue();
  connect(&model_, &ObjectListModel::updated, this, update);
  connect(&model_, &QAbstractItemModel::modelReset, this, update);
  connect(&model_, &QAbstractItemModel::dataChanged, this, &ObjectPanel::updateActions);
  connect(list_->selectionModel(), &QItemSelectionModel::selectionChanged, this,
          &ObjectPanel::updateSelection);
  connectFilter();
  update();
}

void ObjectPanel::connectFilter() {
  // The list shows other rows.
  connect(&list_->filter(), &QAbstractItemModel::layoutChanged, this, [this] {
    updateCounts();
    updateSelection();
  });
  connect(filter_bar_, &ObjectFilterBar::listWanted, this, [this] {
    list_->setFocus(Qt::OtherFocusReason);
    if (list_->selection().empty()) list_->setCurrentIndex(list_->filter().index(0, 0));
  });
}

QWidget* ObjectPanel::makeHead() {
  auto* head = new QWidget;
  auto* row = new QHBoxLayout(head);
  row->setContentsMargins(8, 0, 4, 2);
  count_ = new ElidedLabel;
  count_->setProperty("muted", true);
  row->addWidget(count_, 1);
  to_newest_ = new QToolButton;
  QSizePolicy policy = to_newest_->sizePolicy();
  policy.setRetainSizeWhenHidden(true);  // so that the list below does not move
  to_newest_->setSizePolicy(policy);
  to_newest_->setToolTip(tr("Go to the objects of this scan further down"));
  row->addWidget(to_newest_);
  connect(to_newest_, &QToolButton::clicked, list_, &QAbstractItemView::scrollToBottom);
  const auto update = [this] {
    const int below = list_->newBelow();
    to_newest_->setText(tr("↓ %1 new").arg(below));
    to_newest_->setVisible(below > 0);
  };
  connect(list_, &ObjectListView::newBelowChanged, this, update);
  update();
  return head;
}

void ObjectPanel::makeActions() {
  const auto make = [this](const char* picture, const QString& text, const QString& help,
                           const QList<QKeySequence>& keys, auto&& slot) {
    auto* action = new QAction(icon(QString::fromLatin1(picture)), text, this);
    action->setToolTip(QStringLiteral("%1 (%2)").arg(help, keys.first().toString(QKeySequence::NativeText)));
    action->setShortcuts(keys);
    action->setAutoRepeat(false);
    // Only with focus in the list, because Return and Del are also needed for editing names.
    action->setShortcutContext(Qt::WidgetShortcut);
    connect(action, &QAction::triggered, this, slot);
    list_->addAction(action);
    return action;
  };
  actions_.page =
      make("cube", tr("Object &page"), tr("Show views, 3D model and scans of the object"),
           {QKeySequence(Qt::CTRL | Qt::Key_Return), QKeySequence(Qt::CTRL | Qt::Key_Enter)}, [this] {
             if (selected_.size() == 1) emit pageRequested(selected_.front());
           });
  connect(list_, &ObjectListView::pageRequested, this, &ObjectPanel::pageRequested);
  actions_.rename =
      make("rename", tr("&Rename"), tr("Give the object a name"), {QKeySequence(Qt::Key_F2)}, [this] {
        if (selected_.size() == 1) list_->editName(selected_.front());
      });
  actions_.confirm =
      make("confirm", tr("&Confirm"), tr("Confirm that this is an object and its name is right"),
           {QKeySequence(Qt::Key_Return), QKeySequence(Qt::Key_Enter)}, [this] {
             const bool confirms = confirms_;
             editor_.setConfirmed(selected_, confirms);
             if (confirms) emit confirmed(selected_);
           });
  actions_.merge = make("merge", tr("&Merge"), tr("Merge the selected objects into one"),
                        {QKeySequence(Qt::Key_M)}, [this] { editor_.merge(selected_); });
  actions_.remove = make("delete", tr("&Delete"), tr("Delete the object from the catalogue (can be undone)"),
                         {QKeySequence(Qt::Key_Delete)}, [this] { editor_.remove(selected_); });
}

QWidget* ObjectPanel::makeDetails() {
  details_ = new QWidget;
  auto* layout = new QVBoxLayout(details_);
  layout->setContentsMargins(6, 4, 6, 0);
  layout->setSpacing(4);
  auto* row = new QHBoxLayout;
  row->setSpacing(0);
  selected_name_ = new ElidedLabel;
  QFont bold = selected_name_->font();
  bold.setWeight(QFont::DemiBold);
  selected_name_->setFont(bold);
  row->addWidget(selected_name_, 1);
  for (QAction* action :
       {actions_.page, actions_.rename, actions_.confirm, actions_.merge, actions_.remove}) {
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

void ObjectPanel::updateCatalogue() {
  const QString file = editor_.file();
  const std::string project = editor_.isOpen() ? projectOfCatalogue(file.toStdString()).name : std::string();
  catalogue_->setFullText(editor_.isOpen() ? QString::fromStdString(project) : tr("No catalogue"),
                          editor_.isOpen() ? plainTip(tr("Catalogue: %1").arg(file)) : QString());
}

void ObjectPanel::updateCounts() {
  constexpr int kList = 0, kNoObjects = 1, kNoMatch = 2;
  const int all = model_.rowCount();
  const int listed = list_->filter().rowCount();
  pages_->setCurrentIndex(all == 0 ? kNoObjects : (listed == 0 ? kNoMatch : kList));
  count_->setFullText(all == 0 ? QString()
                               : tr("%1 of %2 named, %3 confirmed")
                                     .arg(list_->filter().namedCount())
                                     .arg(listed)
                                     .arg(list_->filter().confirmedCount()));
  filter_bar_->setVisible(all > 0);
  details_->setVisible(all > 0);
}

void ObjectPanel::updateActions() {
  if (QApplication::activePopupWidget() != nullptr) return;
  confirms_ = std::any_of(selected_.begin(), selected_.end(), [this](ObjectId object) {
    const ObjectRecord* record = model_.record(object);
    return record != nullptr && (!record->confirmed || model_.isChanged(object));
  });
  const bool any = !selected_.empty();
  actions_.page->setEnabled(selected_.size() == 1);
  actions_.rename->setEnabled(selected_.size() == 1);
  actions_.confirm->setEnabled(any);
  actions_.confirm->setText(confirms_ || !any ? tr("&Confirm") : tr("Un&confirm"));
  actions_.remove->setEnabled(any);
  actions_.merge->setEnabled(selected_.size() > 1);
}

void ObjectPanel::updateSelection() {
  std::vector<ObjectId> now = list_->selection();
  const bool is_new = now != selected_;
  selected_ = std::move(now);
  updateActions();
  const ObjectRecord* record = selected_.size() == 1 ? model_.record(selected_.front()) : nullptr;
  selected_name_->setFullText(
      record != nullptr ? QString::fromStdString(record->name)
                        : (selected_.empty() ? QString() : tr("%1 selected").arg(selected_.size())));
  if (record == nullptr) {
    shown_ = {};
    strip_->setViews({}, selected_.empty() ? tr("Select an object to see its views.")
                                           : tr("Select one object to see its views."));
  } else if (record->id != shown_) {
    shown_ = record->id;
    strip_->setViews(editor_.pictures(record->id), tr("This object has no views."));
  } else if (record->views != shown_views_) {
    strip_->updateViews(editor_.pictures(record->id));
  }
  shown_views_ = record != nullptr ? record->views : 0;
  if (is_new) emit selectionChanged(selected_);
}

}  // namespace scantrove
