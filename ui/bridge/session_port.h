#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "core/base/latest_value.h"
#include "core/scan/scan_session.h"

namespace scantrove {

/// What the window needs of a ScanSession: the same functions with the same promises. The window's tests put
/// a scripted session behind it.
class SessionPort {
 public:
  using Listener = std::function<void(const ScanEvent&)>;

  virtual ~SessionPort() = default;
  virtual void start(ScanRequest request) = 0;
  virtual void pause() = 0;
  virtual void resume() = 0;
  virtual void step() = 0;
  virtual void stop() = 0;
  virtual void close() = 0;
  virtual void skipRefinement() = 0;
  virtual void edit(ScanEdit edit) = 0;
  virtual void showKeyFrame(int place) = 0;
  virtual void previewExport(ExportOptions options) = 0;
  virtual void sampleExport(ExportOptions options, std::optional<int> place) = 0;
  virtual void exportDataset(ExportOptions options) = 0;
  virtual void cancelExport() = 0;
  virtual void catalogueChanged() = 0;
  virtual void setParams(const ScanParams& params) = 0;
  [[nodiscard]] virtual ScanState state() const = 0;
  [[nodiscard]] virtual LatestValue<ScanSnapshot>& snapshots() = 0;
};

/// Makes a session whose events go to `listener`, on the session's own thread.
using SessionFactory = std::function<std::unique_ptr<SessionPort>(SessionPort::Listener listener)>;

/// The real one.
[[nodiscard]] std::unique_ptr<SessionPort> makeScanSessionPort(SessionPort::Listener listener);

}  // namespace scantrove
