#pragma once
#include <string>
#include <vector>

#include "core/editing/operation.h"
#include "core/editing/region_notes.h"
#include "core/labeling/link_constraint.h"
#include "core/labeling/region_table.h"

namespace scantrove {

/// What an operation changed, so that it can be taken back, and done again, whatever frames did meanwhile.
struct OperationEffect {
  struct UserConstraint {
    FragmentId a, b;
    LinkConstraint before = LinkConstraint::none, after = LinkConstraint::none;
    bool operator==(const UserConstraint&) const = default;
  };
  struct Note {
    RegionId region;
    RegionNote before, after;
    bool operator==(const Note&) const = default;
  };
  std::vector<RegionMove> moves;
  std::vector<UserConstraint> constraints;
  std::vector<Note> notes;

  bool operator==(const OperationEffect&) const = default;
};

/// All that was done, in order; none is ever dropped. What was undone can be done again until something else
/// is done. One thread.
class OperationLog {
 public:
  enum class State {
    done,
    undone,     ///< can be done again
    superseded  ///< was undone, then something else was done
  };
  struct Entry {
    int number = 0;  ///< 1, 2, ...
    Operation operation;
    OperationEffect effect;
    State state = State::done;
  };

  void add(Operation operation, OperationEffect effect);
  /// An entry as it was read back, in order.
  void restore(Entry entry);

  /// The newest that is done, now undone; null: there is none.
  [[nodiscard]] const Entry* undo();
  /// The oldest of those undone last, now done again; null: there is none.
  [[nodiscard]] const Entry* redo();

  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }

  /// `part` was cut out of `fragment` just now: what was done to that was done to it.
  void splitOff(FragmentId part, FragmentId fragment);
  /// What that entry changed is so much more: since it was done, or taken back, frames have added to its
  /// regions.
  void extend(int number, const OperationEffect& more);
  /// The fragment is no more; its number may come again for another.
  void forget(FragmentId fragment);

  /// Entries (by place) that changed since the last call: for one who keeps a copy.
  [[nodiscard]] std::vector<std::size_t> takeChanged();

 private:
  void noteChange(std::size_t place);

  std::vector<Entry> entries_;
  std::vector<std::size_t> changed_;
};

}  // namespace scantrove
