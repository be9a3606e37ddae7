#pragma once
#include <QUndoStack>
#include <memory>
#include <vector>

namespace scantrove {

/// All that a person did in the window and can take back, in the order in which it was done, whatever part of
/// the window it was done in. The window's thread.
class UndoHistory {
 public:
  /// Whose steps they are: a part of the window.
  using Owner = const void*;
  using Step = std::shared_ptr<QUndoCommand>;

  UndoHistory() = default;
  UndoHistory(const UndoHistory&) = delete;
  UndoHistory& operator=(const UndoHistory&) = delete;

  /// Does the step (its redo()), and remembers it. One that is obsolete by then is forgotten.
  void push(Owner owner, Step step);
  /// Steps that were done before anything else in here. Those from `done` on can be done again, unless
  /// something has been done since.
  void learn(Owner owner, const std::vector<Step>& steps, std::size_t done);
  /// The owner's steps can no longer be taken back, or this one cannot.
  void forget(Owner owner);
  void forget(const QUndoCommand& step);

  /// Takes the newest step back if it is the owner's. False: it is another's.
  bool undoNewest(Owner owner);

  /// For the actions and the list.
  [[nodiscard]] QUndoStack& stack() { return stack_; }

 private:
  class Entry;
  struct Remembered {
    Owner owner = nullptr;
    Step step;
    bool is_done = false;
  };
  [[nodiscard]] std::vector<Remembered> all() const;
  void replaceAll(const std::vector<Remembered>& steps);

  QUndoStack stack_;
  bool is_replaced_ = false;  // while it is: nothing is done or taken back
};

}  // namespace scantrove
