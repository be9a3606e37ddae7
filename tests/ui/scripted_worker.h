#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/overloaded.h"
#include "core/editing/operation.h"
#include "ui/bridge/scan_port.h"

namespace scantrove::test {

/// Takes commands as a ScanWorker does, records them, and reports as the test requests: events through the
/// listener, snapshots through the mailbox.
class ScriptedWorker {
 public:
  explicit ScriptedWorker(ScanListener listener) : listener_(std::move(listener)) {}

  /// A factory of ports that sets `worker` to the newest worker.
  static ScanPortFactory factory(ScriptedWorker*& worker) {
    return [&worker](ScanListener listener) -> ScanPort {
      const auto created = std::make_shared<ScriptedWorker>(std::move(listener));
      worker = created.get();
      return {[created](ScanCommand command) { created->take(std::move(command)); },
              {created, &created->snapshots_}};
    };
  }

  [[nodiscard]] LatestValue<ScanSnapshot>& snapshots() { return snapshots_; }
  void report(const ScanEvent& event) { listener_(event); }
  void report(ScanSnapshot snapshot) {
    snapshots_.post(std::make_shared<const ScanSnapshot>(std::move(snapshot)));
  }
  /// Answers the newest edit as a scan that has stored it. An operation is completed as a scan completes it:
  /// its names are checked and it has the number of frames before it, so it is not equal to what was sent.
  void storeEdit(std::vector<RegionId> regions = {}) { storeEdit(edits.size() - 1, std::move(regions)); }
  void storeEdit(std::size_t number, std::vector<RegionId> regions) {
    report(Edited{completed(edits.at(number)), std::move(regions)});
  }
  void finish() {
    report(ScanFinished{});
    enter(ScanState::finished);
  }

  std::vector<std::string> commands;  ///< those without a list below
  ScanRequest last_request;
  ScanParams last_params;
  int catalogue_changes = 0;
  std::vector<ScanEdit> edits;
  std::vector<int> key_frames_shown, key_frames_labeled;
  std::vector<ExportOptions> previews, exports;
  std::vector<RenderOptions> renders;
  std::vector<ExportProject> project_exports;
  std::vector<std::pair<ExportOptions, std::optional<int>>> samples;

 private:
  void take(ScanCommand command) {
    std::visit(Overloaded{[this](StartScan& c) { start(std::move(c.request)); },
                          [this](PauseScan) { note("pause", ScanState::paused); },
                          [this](ResumeScan) { note("resume", ScanState::scanning); },
                          [this](StepScan) { commands.emplace_back("step"); },
                          [this](StopScan) {
                            commands.emplace_back("stop");
                            finish();
                          },
                          [this](CloseScan) { commands.emplace_back("close"); },
                          [this](SkipRefinement) { commands.emplace_back("skip refinement"); },
                          [this](EditRegions& c) { edits.push_back(std::move(c.edit)); },
                          [this](ShowKeyFrame c) { key_frames_shown.push_back(c.index); },
                          [this](LabelKeyFrame c) { key_frames_labeled.push_back(c.index); },
                          [this](PreviewExport& c) { previews.push_back(std::move(c.options)); },
                          [this](SampleExport& c) { samples.emplace_back(std::move(c.options), c.index); },
                          [this](ExportDataset& c) { exports.push_back(std::move(c.options)); },
                          [this](RenderPicture& c) { renders.push_back(std::move(c.options)); },
                          [this](ExportProject& c) { project_exports.push_back(std::move(c)); },
                          [this](CancelExport) { commands.emplace_back("cancel export"); },
                          [this](ApplyCatalogueChanges) { ++catalogue_changes; },
                          [this](const SetParams& c) { last_params = c.params; }},
               command);
  }
  void start(ScanRequest request) {
    commands.emplace_back("start");
    last_request = std::move(request);
    enter(ScanState::starting);
    if (last_request.source.find("missing") != std::string::npos) {
      report(ScanFailed{Error{"There is no file or folder " + last_request.source + ".", "Check the path."}});
      enter(ScanState::failed);
    } else {
      enter(last_request.start_paused ? ScanState::paused : ScanState::scanning);
    }
  }
  static ScanEdit completed(const ScanEdit& edit) {
    constexpr int kFramesBefore = 31;
    const auto* const operation = std::get_if<Operation>(&edit);
    if (operation == nullptr) return edit;
    Operation stored = withCheckedNames(*operation).value_or(*operation);
    stored.frame = kFramesBefore;
    return stored;
  }
  void enter(ScanState state) { listener_(StateChanged{state}); }
  void note(const char* command, ScanState state) {
    commands.emplace_back(command);
    enter(state);
  }

  ScanListener listener_;
  LatestValue<ScanSnapshot> snapshots_;
};

}  // namespace scantrove::test
