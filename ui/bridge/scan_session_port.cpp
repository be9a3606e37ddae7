#include "core/scan/scan_session.h"
#include "ui/bridge/session_port.h"

namespace scantrove {
namespace {

class ScanSessionPort final : public SessionPort {
 public:
  explicit ScanSessionPort(Listener listener) : session_(std::move(listener), Niceness::scan_beside_window) {}

  void start(ScanRequest request) override { session_.start(std::move(request)); }
  void pause() override { session_.pause(); }
  void resume() override { session_.resume(); }
  void step() override { session_.step(); }
  void stop() override { session_.stop(); }
  void close() override { session_.close(); }
  void skipRefinement() override { session_.skipRefinement(); }
  void edit(ScanEdit edit) override { session_.edit(std::move(edit)); }
  void showKeyFrame(int place) override { session_.showKeyFrame(place); }
  void previewExport(ExportOptions options) override { session_.previewExport(std::move(options)); }
  void sampleExport(ExportOptions options, std::optional<int> place) override {
    session_.sampleExport(std::move(options), place);
  }
  void exportDataset(ExportOptions options) override { session_.exportDataset(std::move(options)); }
  void cancelExport() override { session_.cancelExport(); }
  void catalogueChanged() override { session_.catalogueChanged(); }
  void setParams(const ScanParams& params) override { session_.setParams(params); }
  [[nodiscard]] ScanState state() const override { return session_.state(); }
  [[nodiscard]] LatestValue<ScanSnapshot>& snapshots() override { return session_.snapshots(); }

 private:
  ScanSession session_;
};

}  // namespace

std::unique_ptr<SessionPort> makeScanSessionPort(SessionPort::Listener listener) {
  return std::make_unique<ScanSessionPort>(std::move(listener));
}

}  // namespace scantrove
