#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scan/scan_event.h"
#include "core/scan/scan_parts.h"
#include "core/session/session_writer.h"

namespace scantrove {

/// Opens everything that a scan works with: source, device, result folder, session, catalogue and map. A
/// session that the scan goes on in, or refines, is read back into the map.
class ScanOpener {
 public:
  /// `listener` is told what is damaged, and that kernels are compiled; it outlives the parts. `on_events`:
  /// there is news of the catalogue; called on another thread. Error: what cannot be opened, or would not fit
  /// the device. The result folder and the catalogue may have been made by then.
  [[nodiscard]] static Result<ScanParts> open(const ScanRequest& request, const ScanListener& listener,
                                              std::function<void()> on_events);

 private:
  ScanOpener(const ScanRequest& request, const ScanListener& listener) : listener_(listener) {
    parts_.request = request;
  }

  [[nodiscard]] Result<void> openAll();
  /// Error: the folder holds files of others.
  [[nodiscard]] Result<void> checkFolder() const;
  /// Opens what the frames come from; of a session that is only refined, the session.
  [[nodiscard]] Result<void> openFrames();
  [[nodiscard]] Result<void> openSessionToRefine();
  [[nodiscard]] Result<void> openOutput();
  /// Begins the session, or goes on in it. An earlier one gives way to the first usable frame.
  [[nodiscard]] Result<void> openSession(const SourceInfo& info);
  [[nodiscard]] Result<void> beginSession(const SourceInfo& info);
  /// The camera of the earlier scan must be this one; its map's parameters are taken over.
  [[nodiscard]] Result<void> readSession(const SourceInfo& info);
  /// Reads the session. Where it was interrupted while it told its catalogue something, that comes first.
  [[nodiscard]] Result<void> loadEarlier();
  /// The recording's poses are taken: relative to where the scan begins, or began.
  void takePoses();
  [[nodiscard]] Result<void> openMap();
  /// The earlier scan knows its objects by another catalogue's numbers.
  [[nodiscard]] bool isOfAnotherCatalogue(const std::string& catalogue) const;
  [[nodiscard]] Result<void> restoreSession(ObjectDatabase& database);
  /// Frame numbers and times go on after those of the earlier frames.
  void continueNumbers(const std::vector<SavedFrame>& earlier);
  void tellDamages(const std::vector<std::string>& damages) const;

  const ScanListener& listener_;
  ScanParts parts_;
  std::unique_ptr<SessionWriter> session_;  // until the recorder has it
  std::optional<SavedScan> earlier_;        // what the session had
};

}  // namespace scantrove
