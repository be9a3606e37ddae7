#include "core/editing/operation_log.h"

#include <algorithm>
#include <utility>

namespace scantrove {

void OperationLog::add(Operation operation, OperationEffect effect) {
  for (std::size_t place = 0; place < entries_.size(); ++place) {
    if (entries_[place].state != State::undone) continue;
    entries_[place].state = State::superseded;
    noteChange(place);
  }
  const int number = entries_.empty() ? 1 : entries_.back().number + 1;
  entries_.push_back({number, std::move(operation), std::move(effect), State::done});
  noteChange(entries_.size() - 1);
}

void OperationLog::restore(Entry entry) { entries_.push_back(std::move(entry)); }

const OperationLog::Entry* OperationLog::undo() {
  for (std::size_t place = entries_.size(); place-- > 0;) {
    if (entries_[place].state != State::done) continue;
    entries_[place].state = State::undone;
    noteChange(place);
    return &entries_[place];
  }
  return nullptr;
}

const OperationLog::Entry* OperationLog::redo() {
  // Undone entries come after all done ones.
  const auto found = std::ranges::find(entries_, State::undone, &Entry::state);
  if (found == entries_.end()) return nullptr;
  found->state = State::done;
  noteChange(static_cast<std::size_t>(found - entries_.begin()));
  return &*found;
}

void OperationLog::splitOff(FragmentId part, FragmentId fragment) {
  for (std::size_t place = 0; place < entries_.size(); ++place) {
    std::vector<RegionMove>& moves = entries_[place].effect.moves;
    const auto found = std::ranges::find(moves, fragment, &RegionMove::fragment);
    if (found == moves.end()) continue;
    const RegionMove move{part, found->before, found->after};
    moves.push_back(move);
    noteChange(place);
  }
}

void OperationLog::extend(int number, const OperationEffect& more) {
  const auto found = std::ranges::find(entries_, number, &Entry::number);
  if (found == entries_.end()) return;
  OperationEffect& effect = found->effect;
  effect.moves.insert(effect.moves.end(), more.moves.begin(), more.moves.end());
  effect.constraints.insert(effect.constraints.end(), more.constraints.begin(), more.constraints.end());
  noteChange(static_cast<std::size_t>(found - entries_.begin()));
}

void OperationLog::forget(FragmentId fragment) {
  for (std::size_t place = 0; place < entries_.size(); ++place) {
    OperationEffect& effect = entries_[place].effect;
    const bool is_anchor = effect.anchor && effect.anchor == fragment;
    if (is_anchor) effect.anchor = {};
    const auto gone =
        std::erase_if(effect.moves, [=](const auto& move) { return move.fragment == fragment; }) +
        std::erase_if(effect.constraints, [=](const auto& constraint) {
          return constraint.a == fragment || constraint.b == fragment;
        });
    if (gone > 0 || is_anchor) noteChange(place);
  }
}

void OperationLog::noteChange(std::size_t place) {
  if (std::ranges::find(changed_, place) == changed_.end()) changed_.push_back(place);
}

std::vector<std::size_t> OperationLog::takeChanged() { return std::exchange(changed_, {}); }

}  // namespace scantrove
