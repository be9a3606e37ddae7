#pragma once
#include <string>
#include <vector>

#include "core/editing/operation.h"
#include "core/editing/region_notes.h"
#include "core/labeling/link_constraint.h"
#include "core/labeling/region_table.h"

namespace scantrove {

/// Changes of an operation, for undoing and redoing it even if later frames changed the regions.
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
  std::vector<RegionMove> moves = {};
  std::vector<UserConstraint> constraints = {};
  std::vector<Note> notes = {};
  // Of paint:
  /// A fragment of the painted region, which tells what region that has become; none: it was freed.
  FragmentId anchor = {};
  std::vector<RegionId> created = {};  ///< new regions of what was painted out

  bool operator==(const OperationEffect&) const = default;
};

/// All operations in order; none is ever dropped. An undone operation can be redone until another is done.
/// One thread.
class OperationLog {
 public:
  enum class State {
    done,
    undone,     ///< can be redone
    superseded  ///< undone, then another operation was done
  };
  struct Entry {
    int number = 0;  ///< 1, 2, ...
    Operation operation;
    OperationEffect effect;
    State state = State::done;
  };

  void add(Operation operation, OperationEffect effect);
  /// Adds a stored entry; entries come in order.
  void restore(Entry entry);

  /// Marks the newest done entry as undone and returns it; null if there is none.
  [[nodiscard]] const Entry* undo();
  /// Marks the entry undone last as done and returns it; null if there is none.
  [[nodiscard]] const Entry* redo();

  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }

  /// `part` was split from `fragment`: entries for `fragment` now include `part`.
  void splitOff(FragmentId part, FragmentId fragment);
  /// Adds to an entry's effect, because frames have added fragments to its regions since.
  void extend(int number, const OperationEffect& more);
  /// Removes a freed fragment; its number may be reused.
  void forget(FragmentId fragment);

  /// Indices of entries that changed since the last call.
  [[nodiscard]] std::vector<std::size_t> takeChanged();

 private:
  void noteChange(std::size_t place);

  std::vector<Entry> entries_;
  std::vector<std::size_t> changed_;
};

}  // namespace scantrove
