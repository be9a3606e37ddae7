#include "ui/main_window/region_actions.h"

#include "ui/theme/icon.h"

namespace scantrove {

RegionActions::RegionActions(QObject* parent) : QObject(parent) {
  name = make("rename", tr("&Name…"), {Qt::Key_Return, Qt::Key_Enter, Qt::Key_F2},
              tr("Name the region, which makes it an object of the catalogue"));
  join = make("merge", tr("&Join"), {Qt::Key_J}, tr("Join the selected regions into one"));
  cut = make("", tr("&Split…"), {Qt::Key_C},
             tr("Split a region along folds and colour edges, between two strokes or around one"));
  finer = make("", tr("Split &further"), {Qt::Key_Plus, Qt::Key_Equal},
               tr("Split this region at its weakest borders"));
  coarser = make("", tr("&Merge with neighbour"), {Qt::Key_Minus},
                 tr("Merge this region with its most likely neighbour"));
  background = make("", tr("&Background"), {Qt::Key_B},
                    tr("Mark as background (wall, floor, table), which data sets omit"));
  background->setCheckable(true);
  object = make("cube", tr("Mark as &object"), {Qt::Key_O}, tr("Add the region to the catalogue"));
  reject = make("delete", tr("No&t an object"), {Qt::Key_Delete},
                tr("Mark as not an object; it is not suggested again"));
  reject->setCheckable(true);
  accept = make("", tr("&Accept suggestion"), {Qt::Key_A}, tr("Accept this suggestion"));
  accept_all = make("", tr("Accept &all suggestions"), {QKeySequence(Qt::SHIFT | Qt::Key_A)},
                    tr("Accept all suggestions"));
  not_this =
      make("", tr("Re&ject suggestion"), {Qt::Key_Backspace}, tr("Reject this suggestion permanently"));
  mark_supports = make("", tr("Mark s&upports as background"), {QKeySequence(Qt::CTRL | Qt::Key_B)},
                       tr("Mark all surfaces that things stand on as background"));
  next = make("", tr("Ne&xt region"), {Qt::Key_Tab}, tr("Select the next smaller region"));
  previous = make("", tr("Pre&vious region"), {QKeySequence(Qt::SHIFT | Qt::Key_Tab)},
                  tr("Select the next larger region"));
  fit =
      make("fit", tr("&Zoom to selection"), {Qt::Key_Period}, tr("Show the selected region in the 3D view"));
  deselect = make("", tr("&Deselect"), {Qt::Key_Escape}, tr("Clear the selection"));
  for (int i = 1; i <= 9; ++i) recent << make("", {}, {QKeySequence(Qt::Key_0 + i)}, tr("Give this name"));
  setRecentNames({});
  enableFor(0, false, false);
  enableProposals(false);
  enableSupports(false);
}

void RegionActions::enableProposals(bool any) {
  for (QAction* action : {accept, accept_all, not_this}) action->setEnabled(any);
}

QAction* RegionActions::make(const char* picture, const QString& text, const QList<QKeySequence>& keys,
                             const QString& help) {
  auto* action = new QAction(text, this);
  if (*picture != '\0') action->setIcon(icon(QString::fromLatin1(picture)));
  action->setShortcuts(keys);
  action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  action->setAutoRepeat(false);
  action->setToolTip(QStringLiteral("%1 (%2)").arg(help, keys.first().toString(QKeySequence::NativeText)));
  return action;
}

QList<QAction*> RegionActions::onSelection() const {
  return {name, object, join, cut, finer, coarser, background, reject, fit, deselect};
}

QList<QAction*> RegionActions::all() const {
  return onSelection() + QList{accept, accept_all, not_this, mark_supports, next, previous} + recent;
}

void RegionActions::enableFor(std::size_t count, bool is_background, bool is_rejected) {
  for (QAction* action : {name, finer, coarser, background, object, reject, fit, deselect})
    action->setEnabled(count > 0);
  join->setEnabled(count > 0);  // with one region it says how to join
  background->setChecked(count > 0 && is_background);
  reject->setChecked(count > 0 && is_rejected);
  for (QAction* action : recent) action->setEnabled(count > 0 && !action->data().toString().isEmpty());
}

void RegionActions::setRecentNames(const QStringList& names) {
  for (int i = 0; i < recent.size(); ++i) {
    const QString known = names.value(i);
    recent[i]->setData(known);
    recent[i]->setText(known);
    recent[i]->setVisible(!known.isEmpty());
  }
}

}  // namespace scantrove
