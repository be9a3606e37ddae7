#include "ui/main_window/region_actions.h"

#include "ui/theme/icon.h"

namespace scantrove {

RegionActions::RegionActions(QObject* parent) : QObject(parent) {
  name = make("rename", tr("&Name…"), {Qt::Key_Return, Qt::Key_Enter, Qt::Key_F2},
              tr("Say what it is; the catalogue gets an object of that name"));
  join = make("merge", tr("&Join"), {Qt::Key_J}, tr("The selected regions are one thing"));
  cut = make("", tr("&Cut…"), {Qt::Key_C}, tr("Two places that you draw over, or click on, are two things"));
  finer = make("", tr("&Finer"), {Qt::Key_Plus, Qt::Key_Equal}, tr("Take this region apart"));
  coarser = make("", tr("C&oarser"), {Qt::Key_Minus},
                 tr("Join it with the neighbour that it most likely belongs to"));
  background = make("", tr("&Background"), {Qt::Key_B},
                    tr("Wall, floor, table: not an object, left out of data sets"));
  background->setCheckable(true);
  object = make("cube", tr("It is an &object"), {Qt::Key_O}, tr("Into the catalogue, whole or not"));
  reject = make("delete", tr("&Reject"), {Qt::Key_Delete}, tr("Not an object, and not to be proposed again"));
  reject->setCheckable(true);
  accept = make("", tr("&Yes"), {Qt::Key_A}, tr("What is proposed bears the name"));
  accept_all = make("", tr("Yes to &all"), {QKeySequence(Qt::SHIFT | Qt::Key_A)},
                    tr("All that is proposed bears the name"));
  not_this = make("", tr("N&o"), {Qt::Key_Backspace}, tr("It is something else, and is not proposed again"));
  next = make("", tr("Ne&xt region"), {Qt::Key_Tab}, tr("Select the next smaller region"));
  previous = make("", tr("Pre&vious region"), {QKeySequence(Qt::SHIFT | Qt::Key_Tab)},
                  tr("Select the next larger region"));
  fit = make("fit", tr("&Show it"), {Qt::Key_Period}, tr("Look at what is selected in 3D"));
  deselect = make("", tr("&Let go"), {Qt::Key_Escape}, tr("Select nothing"));
  for (int i = 1; i <= 9; ++i) recent << make("", {}, {QKeySequence(Qt::Key_0 + i)}, tr("Give it this name"));
  setRecentNames({});
  enableFor(0, false, false);
  enableProposals(false);
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
  return onSelection() + QList{accept, accept_all, not_this, next, previous} + recent;
}

void RegionActions::enableFor(std::size_t count, bool is_background, bool is_rejected) {
  for (QAction* action : {name, finer, coarser, background, object, reject, fit, deselect})
    action->setEnabled(count > 0);
  join->setEnabled(count > 1);
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
