#include "ui/main_window/review_controller.h"

#include <utility>

#include "ui/main_window/region_operations.h"
#include "ui/panels/time_line.h"

namespace scantrove {

ReviewController::ReviewController(TimeLine& time_line, RegionOperations& operations, QObject* parent)
    : QObject(parent),
      time_line_(time_line),
      operations_(operations),
      check_(make(tr("Mark image as chec&ked"), tr("K"),
                  tr("The labels of this key frame are right; go to the next open one"))),
      leave_out_(make(tr("&Leave image out"), tr("Shift+K"),
                      tr("No data set has this key frame; go to the next open one"))),
      reopen_(make(tr("Mark image as &open"), tr("Ctrl+Shift+K"), tr("This key frame is to be checked"))),
      next_(make(tr("Next open key frame"), tr("Ctrl+PgDown"),
                 tr("Go to the next key frame that is not checked"))),
      previous_(make(tr("Previous open key frame"), tr("Ctrl+PgUp"),
                     tr("Go to the previous key frame that is not checked"))) {
  connect(check_, &QAction::triggered, this, [this] { review(ReviewState::checked); });
  connect(leave_out_, &QAction::triggered, this, [this] { review(ReviewState::left_out); });
  connect(reopen_, &QAction::triggered, this, [this] { review(ReviewState::open); });
  connect(next_, &QAction::triggered, this, [this] { go(1); });
  connect(previous_, &QAction::triggered, this, [this] { go(-1); });
  connect(&time_line_.reviews(), &KeyFrameReviews::changed, this, &ReviewController::updateActions);
  updateActions();
}

QAction* ReviewController::make(const QString& text, const QString& key, const QString& help) {
  auto* action = new QAction(text, this);
  action->setShortcut(QKeySequence(key));
  action->setToolTip(
      QStringLiteral("%1 (%2)").arg(help, action->shortcut().toString(QKeySequence::NativeText)));
  return action;
}

QList<QAction*> ReviewController::actions() const { return {check_, leave_out_, reopen_, next_, previous_}; }

void ReviewController::review(ReviewState state) {
  const int index = time_line_.current();
  const FrameReview* const shown = time_line_.reviews().at(index);
  if (shown == nullptr || shown->key_frame < 0) return;
  if (shown->state != state) {
    Operation operation;
    operation.kind = OperationKind::review;
    operation.review = *shown;
    operation.review->state = state;
    operations_.perform(std::move(operation));
    time_line_.reviews().set(index, state);
  }
  if (state != ReviewState::open) go(1);
}

void ReviewController::go(int step) {
  const int index = time_line_.reviews().next(time_line_.current(), step, ReviewFilter::open);
  if (index >= 0) time_line_.go(index);
}

void ReviewController::updateActions() {
  const ReviewCounts counts = time_line_.reviews().counts();
  for (QAction* action : {check_, leave_out_, reopen_}) action->setEnabled(counts.all() > 0);
  for (QAction* action : {next_, previous_}) action->setEnabled(counts.open > 0);
}

}  // namespace scantrove
