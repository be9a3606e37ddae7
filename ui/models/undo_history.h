#pragma once
#include <QUndoStack>
#include <memory>
#include <vector>

namespace scantrove {

/// Undo steps of all parts of the window, in the order of the edits. Use from the window's thread.
class UndoHistory {
 public:
  /// The part of the window that a step belongs to.
  using Owner = const void*;
  using Step = std::shared_ptr<QUndoCommand>;

  UndoHistory() = default;
  UndoHistory(const UndoHistory&) = delete;
  UndoHistory& operator=(const UndoHistory&) = delete;

  /// Runs redo() of the step and stores it, unless it is obsolete after that.
  void push(Owner owner, Step step);
  /// Adds a step that is done already. Undone steps can no longer be redone.
  void append(Owner owner, Step step);
  /// Adds steps from before all others. Steps from index `done` on can be redone, unless another step has
  /// been done since.
  void prepend(Owner owner, const std::vector<Step>& steps, std::size_t done);
  /// Removes the steps of an owner, or one step.
  void forget(Owner owner);
  void forget(const QUndoCommand& step);

  /// Undoes the newest step if it belongs to the owner. False: it belongs to another.
  bool undoNewest(Owner owner);

  /// For undo and redo actions and the history list.
  [[nodiscard]] QUndoStack& stack() { return stack_; }

 private:
  class Entry;
  struct StepState {
    Owner owner = nullptr;
    Step step;
    bool is_done = false;
  };
  [[nodiscard]] std::vector<StepState> all() const;
  void replaceAll(const std::vector<StepState>& steps);

  QUndoStack stack_;
  bool is_replaced_ = false;  // while true, steps are neither undone nor redone
};

}  // namespace scantrove
