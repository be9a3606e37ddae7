// What users do to the regions while the frames go by.
#include "core/compute/guarded.h"
#include "core/scan/scan_pipeline.h"

namespace scantrove {

Result<RegionEditor::Outcome> ScanPipeline::edit(const Operation& operation) {
  Operation said = operation;
  said.frame = frames_;
  return guarded("editing the regions", [&] { return finishEdit(editor_->apply(said, params_.labeling)); });
}

Result<RegionEditor::Outcome> ScanPipeline::undo() {
  return guarded("undoing", [&] { return finishEdit(editor_->undo()); });
}

Result<RegionEditor::Outcome> ScanPipeline::redo() {
  return guarded("doing it again", [&] { return finishEdit(editor_->redo()); });
}

Result<RegionEditor::Outcome> ScanPipeline::finishEdit(Result<RegionEditor::Outcome> outcome) {
  if (outcome) follow(outcome->events);
  return outcome;
}

}  // namespace scantrove
