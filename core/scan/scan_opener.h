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

/// Opens all parts of a scan: source, device, result folder, session, catalogue and map. If the scan
/// continues or refines a session, the map is restored from it.
class ScanOpener {
 public:
  /// `listener` receives damages and the start of kernel compilation; it outlives the parts. `on_events`:
  /// events of the catalogue wait; called on another thread. Error: a part cannot be opened, or would not
  /// fit the device. The result folder and the catalogue may exist by then.
  [[nodiscard]] static Result<ScanParts> open(const ScanRequest& request, const ScanListener& listener,
                                              std::function<void()> on_events);

 private:
  ScanOpener(const ScanRequest& request, const ScanListener& listener) : listener_(listener) {
    parts_.request = request;
  }

  [[nodiscard]] Result<void> openAll();
  /// Parameters for scanning one object alone. Error: the request continues a scan.
  [[nodiscard]] Result<void> chooseObject();
  /// Error: the folder contains files of others.
  [[nodiscard]] Result<void> checkFolder() const;
  /// Opens the source of the frames; to refine a session, the session.
  [[nodiscard]] Result<void> openFrames();
  /// Replaces automatic parameters, by the camera and the first frame.
  void fitMapToSensor();
  [[nodiscard]] Result<void> openSessionToRefine();
  /// A session may have been copied without the network of the scan.
  void dropMissingNetwork();
  [[nodiscard]] Result<void> openOutput();
  /// Starts or continues the session. An earlier session is replaced at the first usable frame.
  [[nodiscard]] Result<void> openSession(const SourceInfo& info);
  [[nodiscard]] Result<void> beginSession(const SourceInfo& info);
  /// The camera of the earlier scan must be the same; its map's parameters are used.
  [[nodiscard]] Result<void> readSession(const SourceInfo& info);
  /// Restores the session. Edits of the catalogue that were interrupted are completed first.
  [[nodiscard]] Result<void> loadEarlier();
  /// With `resume`, poses are used as in the earlier scan, unless the request says how.
  void continuePoseUse(const std::string& earlier, const SourceInfo& info);
  /// Uses the recording's poses, relative to the start of this or the earlier scan.
  void takePoses();
  /// The source is the last recording of the earlier scan.
  [[nodiscard]] bool isSameRecording() const;
  [[nodiscard]] Result<void> openMap();
  /// The earlier scan's object ids belong to another catalogue.
  [[nodiscard]] bool isOfAnotherCatalogue(const std::string& catalogue) const;
  [[nodiscard]] Result<void> restoreSession(ObjectDatabase& database);
  /// Of a scan that was interrupted before its map was stored nothing is left to go on in.
  void beginAnewWithoutMap();
  /// With `rest_only`, the source goes on after its last frame in the session.
  void leaveOutReadFrames();
  /// Frame numbers and times continue those of the earlier frames.
  void continueNumbers(const std::vector<SavedFrame>& earlier);
  void reportDamages(const std::vector<std::string>& damages) const;

  const ScanListener& listener_;
  ScanParts parts_;
  std::unique_ptr<SessionWriter> session_;    // until the recorder takes it
  std::optional<SavedScan> earlier_;          // the data in the session
  std::optional<Intrinsics> own_intrinsics_;  // of the recording, if the session has others
};

}  // namespace scantrove
