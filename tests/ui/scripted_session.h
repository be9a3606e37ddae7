#pragma once
#include <QString>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ui/bridge/session_port.h"

namespace scantrove::test {

/// A session that does what the test says and writes down what the window asked of it. What the test posts
/// arrives exactly as from the real one: events by the listener, snapshots by the mailbox.
class ScriptedSession final : public SessionPort {
 public:
  explicit ScriptedSession(Listener listener) : listener_(std::move(listener)) {}

  void start(ScanRequest request) override {
    commands.push_back("start");
    last_request = std::move(request);
    enter(ScanState::starting);
    if (last_request.source.find("missing") != std::string::npos) {
      post(ScanFailed{Error{"There is no file or folder " + last_request.source + ".", "Check the path."}});
      enter(ScanState::failed);
    } else {
      enter(last_request.start_paused ? ScanState::paused : ScanState::scanning);
    }
  }
  void pause() override { note("pause", ScanState::paused); }
  void resume() override { note("resume", ScanState::scanning); }
  void step() override { commands.push_back("step"); }
  void stop() override {
    commands.push_back("stop");
    finish();
  }
  void close() override { commands.push_back("close"); }
  void skipRefinement() override { commands.push_back("skip refinement"); }
  void edit(ScanEdit edit) override { edits.push_back(std::move(edit)); }
  void showKeyFrame(int place) override { key_frames_shown.push_back(place); }
  void previewExport(ExportOptions options) override { previews.push_back(std::move(options)); }
  void sampleExport(ExportOptions options, std::optional<int> place) override {
    samples.emplace_back(std::move(options), place);
  }
  void exportDataset(ExportOptions options) override { exports.push_back(std::move(options)); }
  void cancelExport() override { commands.push_back("cancel export"); }
  void catalogueChanged() override { ++catalogue_changes; }
  void setParams(const ScanParams& params) override { last_params = params; }
  [[nodiscard]] ScanState state() const override { return state_; }
  [[nodiscard]] LatestValue<ScanSnapshot>& snapshots() override { return mailbox_; }

  void post(const ScanEvent& event) { listener_(event); }
  void post(ScanSnapshot snapshot) {
    mailbox_.post(std::make_shared<const ScanSnapshot>(std::move(snapshot)));
  }
  void finish() {
    post(ScanFinished{});
    enter(ScanState::finished);
  }

  std::vector<std::string> commands;
  ScanRequest last_request;
  ScanParams last_params;
  int catalogue_changes = 0;
  std::vector<ScanEdit> edits;
  std::vector<int> key_frames_shown;
  std::vector<ExportOptions> previews, exports;
  std::vector<std::pair<ExportOptions, std::optional<int>>> samples;

 private:
  void enter(ScanState state) {
    state_ = state;
    listener_(StateChanged{state});
  }
  void note(const char* command, ScanState state) {
    commands.emplace_back(command);
    enter(state);
  }

  Listener listener_;
  LatestValue<ScanSnapshot> mailbox_;
  ScanState state_ = ScanState::idle;
};

}  // namespace scantrove::test
