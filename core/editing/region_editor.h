#pragma once
#include <functional>
#include <optional>
#include <set>
#include <vector>

#include "core/base/result.h"
#include "core/editing/editable_map.h"
#include "core/editing/editable_regions.h"
#include "core/editing/operation_log.h"
#include "core/editing/painted_surface.h"
#include "core/labeling/labeling_params.h"
#include "core/labeling/region_merger.h"

namespace scantrove {

/// Applies and undoes a person's edits of regions, between two frames or without any. Edits also constrain
/// later frames. The thread of map and merger; may throw cl::Error.
class RegionEditor {
 public:
  /// All arguments must outlive the editor.
  RegionEditor(RegionTable& table, RegionMerger& merger, EditableMap& map)
      : table_(table), merger_(&merger), map_(map) {}

  struct Outcome {
    RegionEvents events;
    std::vector<RegionId> regions;  ///< resulting regions of the operation; of a cut: here, there
    Operation operation;            ///< that was done, undone or redone
  };

  /// Names are stored as checkedLabelName and checkedCategoryName return them.
  /// A cut without places on the other side separates what the given places show from what surrounds them in
  /// other colours. On an error nothing changes: unknown region, invalid name, a cut with both sides at one
  /// place, nothing to split, ... `painted`: of a paint, the surface behind the image; null corrects the
  /// image alone. A review only enters the log.
  [[nodiscard]] Result<Outcome> apply(const Operation& given, const LabelingParams& params,
                                      const PaintedSurface* painted = nullptr);
  /// Undoes only the newest operation. Later changes by frames stay. Fragments that frames split off since,
  /// or added to a part of a cut, move with the rest of their region. Error if there is no operation.
  [[nodiscard]] Result<Outcome> undo();
  /// Redoes the operation on the current regions, including fragments that frames added since. Error if there
  /// is none.
  [[nodiscard]] Result<Outcome> redo();

  [[nodiscard]] const OperationLog& log() const { return log_; }
  [[nodiscard]] OperationLog& log() { return log_; }
  [[nodiscard]] const RegionNotes& notes() const { return notes_; }
  /// Sets a stored note.
  void restoreNote(RegionId region, const RegionNote& note) { setNote(region, note); }
  void useMerger(RegionMerger& merger) { merger_ = &merger; }
  void forget(FragmentId fragment) { log_.forget(fragment); }
  /// A frame has split `part` from `fragment`: operations on `fragment` now include `part`, also in undo.
  void splitOff(FragmentId part, FragmentId fragment) { log_.splitOff(part, fragment); }

 private:
  using Fragments = std::vector<FragmentId>;
  /// An operation in progress.
  struct Work {
    const Operation& operation;
    const LabelingParams& params;
    const PaintedSurface* painted;
    OperationEffect effect;
    Outcome outcome;
    std::vector<std::pair<FragmentId, RegionId>> before;  // regions of all fragments that it may move
  };

  [[nodiscard]] Result<void> run(Work& work);
  [[nodiscard]] Result<void> note(Work& work);
  [[nodiscard]] Result<void> join(Work& work, const std::vector<RegionId>& regions);
  [[nodiscard]] Result<void> cut(Work& work);
  [[nodiscard]] Result<void> finer(Work& work);
  [[nodiscard]] Result<void> coarser(Work& work);
  [[nodiscard]] Result<void> paint(Work& work);

  /// Before undo or redo: adds all current fragments to the effect for regions that move completely.
  void takeInNewFragments(const OperationLog::Entry& entry, bool is_undo);
  /// Before redoing a join: adds must-links between regions whose constrained fragments no longer exist.
  void holdTogether(const OperationLog::Entry& entry);
  [[nodiscard]] bool exists(RegionId region) const { return !table_.fragmentsOf(region).empty(); }
  void remember(RegionId region, Work& work) const;
  [[nodiscard]] EditableRegions editable() { return {table_, *merger_, map_, log_}; }
  /// Makes the parts of one region separate regions, with constraints.
  void divide(Work& work, const std::vector<Fragments>& parts);
  void write(Work& work, RegionId region, const RegionNote& note);
  void setNote(RegionId region, const RegionNote& note);

  RegionTable& table_;
  RegionMerger* merger_;
  EditableMap& map_;
  RegionNotes notes_;
  OperationLog log_;
};

}  // namespace scantrove
