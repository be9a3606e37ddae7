#pragma once
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/capture/continued_source.h"
#include "core/collection/object_collector.h"
#include "core/fusion/stored_page.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/session/key_frame_choice.h"
#include "core/session/session_writer.h"

namespace scantrove {

/// Keeps a scan in a session while it runs: every few seconds what changed since, and the frames that show
/// something new. What the disk takes its time for, a thread of its own waits for. The pages of the map go a
/// few with each frame, and no more than the disk takes, so that neither time nor memory is needed for many
/// at once; with the last of them goes all else, and only then they are part of the session. Of a scan that
/// breaks off, pages may so be as much older than the rest as that took; restoreScan() knows. One thread, the
/// worker's.
class SessionRecorder {
 public:
  /// A killed program loses no more than this, and what the disk was slower.
  static constexpr std::chrono::milliseconds kBetweenSaves{4000};

  /// Of a young map, which beginAnew() may give up; with those that were understood late.
  static constexpr std::size_t kFirstFrames = 64;

  struct StoredFrame {
    SavedKeyFrame images;
    SavedFrame frame;
  };

  struct Setup {
    bool all_frames = false;         ///< keep the images of every frame, not of key frames only
    SessionMetadata metadata = {};   ///< of a new scan
    int frames = 0;                  ///< that the session has already
    KeyFrameChoice key_frames = {};  ///< that it has
  };
  SessionRecorder(std::unique_ptr<SessionWriter> writer, Setup setup);
  /// Goes on in a session that `pipeline` was just restored from.
  [[nodiscard]] static std::unique_ptr<SessionRecorder> resume(std::unique_ptr<SessionWriter> writer,
                                                               MappingPipeline& pipeline,
                                                               const SavedScan& scan, bool all_frames);

  /// The frames from the next one on are of this recording.
  void beginRecording(const std::string& source, const ContinuedSource::Shift& shift);
  /// After each frame, whether it was usable or not.
  void addFrame(const RgbdFrame& frame, const FrameResult& result);
  /// The map is given up for a new one, before anybody did anything to it: the frames so far are lost.
  void beginAnew();
  /// Hands over what changed, or a part of it, if it is time. Device faults: cl::Error.
  void saveWhenDue(MappingPipeline& pipeline, const ObjectCollector& collector);
  /// Hands over what changed and waits until it is on disk. Without `collector` objects are what they were.
  /// Error: it is not; what is there stays as it was.
  [[nodiscard]] Result<void> save(MappingPipeline& pipeline, const ObjectCollector* collector = nullptr);
  /// The same at the end of the scan. Error: also that other programs removed or replaced files of the
  /// session meanwhile, though they were written anew.
  [[nodiscard]] Result<void> finish(MappingPipeline& pipeline, const ObjectCollector& collector);
  /// Error: other programs removed, moved or replaced files of the session since it was opened.
  [[nodiscard]] Result<void> findDisturbance();
  /// The frames whose images the session has, in order, and how they are kept. Waits until they are on disk.
  /// Error: they cannot be read.
  [[nodiscard]] Result<std::vector<StoredFrame>> storedFrames();
  [[nodiscard]] std::filesystem::path folder() const { return writer_->folder(); }
  /// Without a catalogue that says it: which object a region is from now on. None: it is none.
  void setObject(RegionId region, ObjectId object) { objects_[region] = object; }
  [[nodiscard]] ObjectId objectOf(RegionId region) const;
  [[nodiscard]] const std::map<RegionId, ObjectId>& objects() const { return objects_; }
  void setObjects(std::map<RegionId, ObjectId> objects) { objects_ = std::move(objects); }
  /// On disk the session is as `scan` has it, whatever resume() was given.
  void rewriteFrom(const SavedScan& on_disk, const SessionMetadata& now);
  /// What is to be kept of the whole scan with the next save.
  void setMetadata(const std::string& name, const std::string& value) { setup_.metadata[name] = value; }
  /// The same at once, by itself. Error: it is not on disk.
  [[nodiscard]] Result<void> keepMetadata(const std::string& name, const std::string& value);
  /// Whose the objects are that this scan finds.
  void setCatalogue(const std::string& identity);
  /// Why the session could not be written, once each time that this begins.
  [[nodiscard]] std::optional<Error> takeFailure() { return writer_->takeFailure(); }

 private:
  /// By position.
  using HandedPages = std::vector<std::pair<Eigen::Vector3i, StoredPage>>;

  /// All but the map.
  [[nodiscard]] SavedDelta collect(MappingPipeline& pipeline, const ObjectCollector* collector);
  void collectRegions(MappingPipeline& pipeline, const ObjectCollector* collector, SavedDelta& delta);
  void collectNamings(const ObjectCollector& collector, SavedDelta& delta);
  /// What the catalogue says of the objects.
  void collectObjects(const MappingPipeline& pipeline, const ObjectCollector& collector, SavedDelta& delta);
  /// From now on pages_ are those of the map that changed since they were handed over.
  void beginPages(const BrickMap& bricks);
  /// Hands over so many bricks of pages_, in whole pages. True: those were the last.
  [[nodiscard]] bool handSomePages(BrickMap& bricks, std::size_t enough);
  /// Hands over all else, now that these were all: so they are part of the session.
  void endPages(MappingPipeline& pipeline, const ObjectCollector* collector);
  /// As many of them as may wait are not on disk yet.
  [[nodiscard]] bool arePagesWaiting();
  void hand(SavedDelta delta);
  /// As long as there are few.
  void keepFirst(const SavedFrame& frame);

  std::unique_ptr<SessionWriter> writer_;
  Setup setup_;
  std::map<int, int> number_of_frame_;      // by index of the source, for those that may be understood late
  std::vector<SavedFrame> first_usable_;    // those that beginAnew() is about
  std::vector<SavedFrame> frames_;          // not handed over yet
  std::vector<SavedRecording> recordings_;  // likewise
  std::vector<int> voxels_;                 // of each fragment, as handed over
  std::vector<ViewCoverage> seen_from_;     // likewise
  std::map<RegionId, SavedRegion> regions_;
  std::map<RegionId, ObjectId> objects_;     // where no catalogue says them
  std::map<RegionId, std::string> namings_;  // as handed over
  RememberedObjects remembered_;             // likewise
  std::string catalogue_;                    // identity
  std::vector<int> pages_;                   // of the map, to be handed over; the next one last
  std::vector<std::weak_ptr<const HandedPages>> handed_pages_;
  bool saves_pages_ = false;
  std::uint64_t view_ = 0;       // of the map: no page that lay in view later is part of the session
  std::uint64_t next_view_ = 0;  // the same, when all of pages_ are
  std::chrono::steady_clock::time_point last_handed_;
  std::chrono::steady_clock::time_point last_save_;
};

}  // namespace scantrove
