#include "ui/panels/object_list_view.h"

#include <QEvent>
#include <QItemSelectionModel>
#include <QMouseEvent>
#include <QScrollBar>
#include <algorithm>
#include <utility>

#include "ui/models/object_filter.h"
#include "ui/models/object_list_model.h"
#include "ui/panels/name_editor.h"
#include "ui/panels/object_delegate.h"

namespace scantrove {
namespace {
constexpr int kMinHeight_px = 60;
}

ObjectListView::ObjectListView(CatalogueEditor& editor, ObjectListModel& model, QWidget* parent)
    : QListView(parent), model_(model), filter_(new ObjectFilter(model, this)), name_editor_(nullptr) {
  setModel(filter_);
  setProperty("panel", true);
  setItemDelegate(new ObjectDelegate(this));
  setSelectionMode(QAbstractItemView::ExtendedSelection);
  setEditTriggers(QAbstractItemView::NoEditTriggers);
  setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
  setUniformItemSizes(true);
  setMinimumHeight(kMinHeight_px);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setMouseTracking(true);
  setAccessibleName(tr("Objects"));
  setObjectName(QStringLiteral("objectList"));
  connect(&model_, &ObjectListModel::aboutToUpdate, this, &ObjectListView::storeScrollPosition);
  connect(&model_, &ObjectListModel::updated, this, &ObjectListView::restoreScrollPosition);
  connect(&model_, &ObjectListModel::merged, this, &ObjectListView::moveSelection);
  connect(verticalScrollBar(), &QAbstractSlider::valueChanged, this, &ObjectListView::newBelowChanged);
  name_editor_ = new NameEditor(*this, editor, model);
  connect(this, &QAbstractItemView::doubleClicked, this, [this](const QModelIndex& row) {
    const bool is_picture = ObjectDelegate::pictureRect(visualRect(row)).contains(double_clicked_);
    is_picture ? emit pageRequested(filter_->objectAt(row)) : editName(filter_->objectAt(row));
  });
}

std::vector<ObjectId> ObjectListView::selection() const {
  std::vector<ObjectId> objects;
  for (const QModelIndex& row : selectionModel()->selectedIndexes())
    objects.push_back(filter_->objectAt(row));
  std::sort(objects.begin(), objects.end());
  return objects;
}

QModelIndex ObjectListView::rowOf(ObjectId object) const { return filter_->indexOf(object); }

void ObjectListView::select(const std::vector<ObjectId>& objects) {
  QItemSelection rows;
  QModelIndex first;
  for (const ObjectId object : objects) {
    const QModelIndex row = rowOf(object);
    if (!row.isValid()) continue;
    rows.select(row, row);
    if (!first.isValid() || row.row() < first.row()) first = row;
  }
  selectionModel()->select(rows, QItemSelectionModel::ClearAndSelect);
  if (!first.isValid()) return;
  selectionModel()->setCurrentIndex(first, QItemSelectionModel::NoUpdate);
  scrollTo(first);
}

void ObjectListView::selectNewest() {
  const QModelIndex newest = rowOf(model_.objectAt(model_.index(model_.rowCount() - 1)));
  setCurrentIndex(newest.isValid() ? newest : filter_->index(0, 0));
}

void ObjectListView::editName(ObjectId object) { name_editor_->begin(object); }

bool ObjectListView::finishEditing() { return name_editor_->finish(); }

bool ObjectListView::isPressed() const { return pressed_ || verticalScrollBar()->isSliderDown(); }

bool ObjectListView::isUsed() const {
  return (hasFocus() && selectionModel()->hasSelection()) || name_editor_->isOpen() ||
         viewport()->rect().contains(viewport()->mapFromGlobal(QCursor::pos()));
}

int ObjectListView::newBelow() const {
  if (filter_->order() != ObjectFilter::Order::oldest) return 0;
  const QModelIndex last = indexAt(QPoint(viewport()->width() / 2, viewport()->height() - 1));
  return last.isValid() ? filter_->addedBelow(last.row()) : 0;
}

void ObjectListView::storeScrollPosition() {
  was_at_end_ = verticalScrollBar()->value() == verticalScrollBar()->maximum();
  visible_rows_.clear();
  const auto add = [this](const QModelIndex& row) {
    if (row.isValid()) visible_rows_.emplace_back(row, visualRect(row).top());
  };
  add(indexAt(viewport()->mapFromGlobal(QCursor::pos())));
  const QModelIndex first = indexAt(QPoint(viewport()->width() / 2, 1));
  for (int row = first.row(); first.isValid() && row < filter_->rowCount(); ++row) {
    if (visualRect(filter_->index(row, 0)).top() >= viewport()->height()) break;
    add(filter_->index(row, 0));
  }
}

void ObjectListView::restoreScrollPosition() {
  for (const auto& [row, top] : std::exchange(visible_rows_, {})) {
    if (!row.isValid()) continue;
    verticalScrollBar()->setValue(verticalScrollBar()->value() + visualRect(row).top() - top);
    break;
  }
  if (was_at_end_ && !isUsed() && filter_->order() == ObjectFilter::Order::oldest) scrollToBottom();
  emit newBelowChanged();
}

void ObjectListView::moveSelection(ObjectId into, ObjectId from) {
  const QModelIndex removed_row = rowOf(from);
  const QModelIndex target_row = rowOf(into);
  if (!target_row.isValid() || !selectionModel()->isSelected(removed_row)) return;
  const bool is_current = currentIndex() == removed_row;
  selectionModel()->select(target_row, QItemSelectionModel::Select);
  if (is_current) selectionModel()->setCurrentIndex(target_row, QItemSelectionModel::NoUpdate);
}

bool ObjectListView::viewportEvent(QEvent* event) {
  if (event->type() == QEvent::MouseButtonPress || event->type() == QEvent::MouseButtonDblClick)
    pressed_ = true;
  if (event->type() == QEvent::MouseButtonDblClick)
    double_clicked_ = static_cast<QMouseEvent*>(event)->position().toPoint();
  if (event->type() == QEvent::MouseButtonRelease || event->type() == QEvent::Leave) pressed_ = false;
  return QListView::viewportEvent(event);
}

void ObjectListView::updateGeometries() {
  QListView::updateGeometries();
  emit newBelowChanged();
}

}  // namespace scantrove
