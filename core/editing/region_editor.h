#pragma once
#include <functional>
#include <optional>
#include <set>
#include <vector>

#include "core/base/result.h"
#include "core/editing/editable_map.h"
#include "core/editing/operation_log.h"
#include "core/labeling/labeling_params.h"
#include "core/labeling/region_merger.h"

namespace scantrove {

/// Does to the regions of a scan what a person says, and takes it back. Between two frames or without any;
/// what is said holds for the frames that follow. One thread, that of map and merger; may throw cl::Error.
class RegionEditor {
 public:
  /// All of these outlive the editor.
  RegionEditor(RegionTable& table, RegionMerger& merger, EditableMap& map)
      : table_(table), merger_(&merger), map_(map) {}

  struct Outcome {
    RegionEvents events;
    std::vector<RegionId> regions;  ///< what the operation was about is now; of a cut: here, there
    Operation operation;            ///< that was done, undone or done again
  };

  /// Names are stored as checkedLabelName and checkedCategoryName return them.
  /// Error: there is no such region, a name breaks the rule, a cut whose two sides are one place, nothing to
  /// take apart, ...; then nothing was changed.
  [[nodiscard]] Result<Outcome> apply(const Operation& given, const LabelingParams& params);
  /// Takes the newest operation back, and no more than that: what frames changed meanwhile stays, and what
  /// they cut out of regions meanwhile, or added to a part that a cut had made, goes where the rest of it
  /// goes. Error: there is none.
  [[nodiscard]] Result<Outcome> undo();
  /// Does it again, to the regions as they are now: what frames added to them meanwhile is joined, too.
  /// Error: there is none.
  [[nodiscard]] Result<Outcome> redo();

  [[nodiscard]] const OperationLog& log() const { return log_; }
  [[nodiscard]] OperationLog& log() { return log_; }
  [[nodiscard]] const RegionNotes& notes() const { return notes_; }
  /// As read back from where they were kept.
  void restoreNote(RegionId region, const RegionNote& note) { setNote(region, note); }
  void useMerger(RegionMerger& merger) { merger_ = &merger; }
  void forget(FragmentId fragment) { log_.forget(fragment); }
  /// A frame has shown that `part` is something else than the rest of `fragment`: what was done to that was
  /// done to it, and is taken back with it.
  void splitOff(FragmentId part, FragmentId fragment) { log_.splitOff(part, fragment); }

 private:
  using Fragments = std::vector<FragmentId>;
  /// An operation while it is done.
  struct Work {
    const Operation& operation;
    const LabelingParams& params;
    OperationEffect effect;
    Outcome outcome;
    std::vector<std::pair<FragmentId, RegionId>> before;  // of all fragments that it may move
  };

  [[nodiscard]] Result<void> run(Work& work);
  [[nodiscard]] Result<void> note(Work& work);
  [[nodiscard]] Result<void> join(Work& work, const std::vector<RegionId>& regions);
  [[nodiscard]] Result<void> cut(Work& work);
  [[nodiscard]] Result<void> finer(Work& work);
  [[nodiscard]] Result<void> coarser(Work& work);

  /// Before the entry is taken back or done again: regions that this moves as a whole have all their
  /// fragments of now in its effect.
  void takeInNewFragments(const OperationLog::Entry& entry, bool is_undo);
  /// Before a join is done again: of what held the regions together a fragment may be gone.
  void holdTogether(const OperationLog::Entry& entry);
  [[nodiscard]] bool exists(RegionId region) const { return !table_.fragmentsOf(region).empty(); }
  void remember(RegionId region, Work& work) const;
  /// Voxels of one region, part of each: fragments that lie in several parts are divided. Result: fragments
  /// of each part.
  [[nodiscard]] std::vector<Fragments> divideVoxels(RegionId region, const SurfaceGraph& graph,
                                                    std::span<const std::uint32_t> part, std::size_t parts);
  /// The parts of one region are regions now, and stay so.
  void divide(Work& work, const std::vector<Fragments>& parts);
  void keepApart(Work& work, const Fragments& one, const Fragments& other);
  void say(Work& work, FragmentId a, FragmentId b, LinkConstraint constraint);
  void write(Work& work, RegionId region, const RegionNote& note);
  void setNote(RegionId region, const RegionNote& note);
  [[nodiscard]] FragmentId largestOf(std::span<const FragmentId> fragments) const;
  [[nodiscard]] int voxelsOf(FragmentId fragment) const;

  RegionTable& table_;
  RegionMerger* merger_;
  EditableMap& map_;
  RegionNotes notes_;
  OperationLog log_;
};

}  // namespace scantrove
