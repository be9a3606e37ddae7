#include "ui/models/undo_history.h"

#include <algorithm>
#include <utility>

namespace scantrove {

class UndoHistory::Entry final : public QUndoCommand {
 public:
  Entry(const UndoHistory& history, Owner owner, Step step)
      : QUndoCommand(step->text()), history_(history), owner_(owner), step_(std::move(step)) {}

  void redo() override {
    if (!history_.is_replaced_) step_->redo();
    setObsolete(step_->isObsolete());
  }
  void undo() override {
    if (!history_.is_replaced_) step_->undo();
    setObsolete(step_->isObsolete());
  }
  [[nodiscard]] Owner owner() const { return owner_; }
  [[nodiscard]] const Step& step() const { return step_; }

 private:
  const UndoHistory& history_;
  Owner owner_;
  Step step_;
};

void UndoHistory::push(Owner owner, Step step) { stack_.push(new Entry(*this, owner, std::move(step))); }

void UndoHistory::append(Owner owner, Step step) {
  std::vector<StepState> steps = all();
  std::erase_if(steps, [](const StepState& one) { return !one.is_done; });
  steps.push_back({owner, std::move(step), true});
  replaceAll(steps);
}

void UndoHistory::prepend(Owner owner, const std::vector<Step>& steps, std::size_t done) {
  std::vector<StepState> later = all();
  const bool is_anything_done = std::ranges::any_of(later, &StepState::is_done);
  std::vector<StepState> steps_now;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (i < done || !is_anything_done) steps_now.push_back({owner, steps[i], i < done});
  }
  const bool is_anything_undone = done < steps.size() && !is_anything_done;
  // Steps undone in both histories cannot be ordered, so the later ones are dropped.
  if (is_anything_undone) std::erase_if(later, [](const StepState& one) { return !one.is_done; });
  steps_now.insert(steps_now.end(), later.begin(), later.end());
  replaceAll(steps_now);
}

void UndoHistory::forget(Owner owner) {
  std::vector<StepState> steps = all();
  if (std::erase_if(steps, [owner](const StepState& one) { return one.owner == owner; }) > 0)
    replaceAll(steps);
}

void UndoHistory::forget(const QUndoCommand& step) {
  std::vector<StepState> steps = all();
  if (std::erase_if(steps, [&step](const StepState& one) { return one.step.get() == &step; }) > 0)
    replaceAll(steps);
}

bool UndoHistory::undoNewest(Owner owner) {
  const std::vector<StepState> steps = all();
  const auto newest =
      std::find_if(steps.rbegin(), steps.rend(), [](const StepState& one) { return one.is_done; });
  if (newest == steps.rend() || newest->owner != owner) return false;
  stack_.undo();
  return true;
}

std::vector<UndoHistory::StepState> UndoHistory::all() const {
  std::vector<StepState> steps;
  for (int i = 0; i < stack_.count(); ++i) {
    const auto& entry = static_cast<const Entry&>(*stack_.command(i));
    steps.push_back({entry.owner(), entry.step(), i < stack_.index()});
  }
  return steps;
}

void UndoHistory::replaceAll(const std::vector<StepState>& steps) {
  is_replaced_ = true;
  stack_.clear();
  for (const StepState& one : steps) stack_.push(new Entry(*this, one.owner, one.step));
  stack_.setIndex(static_cast<int>(std::ranges::count_if(steps, &StepState::is_done)));
  is_replaced_ = false;
}

}  // namespace scantrove
