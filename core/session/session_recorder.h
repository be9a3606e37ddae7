#pragma once
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/capture/color_presence.h"
#include "core/capture/continued_source.h"
#include "core/collection/object_collector.h"
#include "core/fusion/stored_page.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/session/key_frame_choice.h"
#include "core/session/region_label.h"
#include "core/session/session_writer.h"

namespace scantrove {

/// Stores a running scan in a session: every few seconds the changes, and the frames that show something
/// new. A separate thread waits for the disk. A few pages of the map are written with each frame, limited
/// by the disk, which bounds time and memory. With the last of them all other changes are written, and only
/// then do they become part of the session. In an interrupted scan, pages may be older than the rest by
/// that time; restoreScan() handles this. One thread, the worker's.
class SessionRecorder {
 public:
  /// Maximum loss of a killed program, besides the delay of the disk.
  static constexpr std::chrono::milliseconds kBetweenSaves{4000};

  /// Frames of a young map, which restart() may drop, including those integrated late.
  static constexpr std::size_t kFirstFrames = 64;

  struct StoredFrame {
    SavedKeyFrame images;
    SavedFrame frame;
  };

  struct Setup {
    bool all_frames = false;            ///< keep the images of every frame, not of key frames only
    SessionMetadata metadata = {};      ///< of a new scan
    int frames = 0;                     ///< already in the session
    KeyFrameChoice key_frames = {};     ///< already in the session
    KeyFrameChoice without_color = {};  ///< likewise; others with colour are still chosen there
    std::optional<SavedObjectness> objectness = {};  ///< to store with the next save
  };
  SessionRecorder(std::unique_ptr<SessionWriter> writer, Setup setup);
  /// Continues a session from which `pipeline` was just restored.
  [[nodiscard]] static std::unique_ptr<SessionRecorder> resume(std::unique_ptr<SessionWriter> writer,
                                                               MappingPipeline& pipeline,
                                                               const SavedScan& scan, bool all_frames);

  /// Frames from the next one on belong to this recording.
  void beginRecording(const std::string& source, const ContinuedSource::Shift& shift);
  /// Call after each frame, usable or not.
  void addFrame(const RgbdFrame& frame, const FrameResult& result);
  /// The map is replaced by a new one before any edit: its frames are lost.
  void restart();
  /// Hands over changes, or a part of them, when due. Device failures: cl::Error.
  void saveWhenDue(MappingPipeline& pipeline, const ObjectCollector& collector);
  /// Hands over changes and waits until they are on disk. Without `collector` objects stay the same. Error:
  /// writing failed; the stored state is unchanged.
  [[nodiscard]] Result<void> save(MappingPipeline& pipeline, const ObjectCollector* collector = nullptr);
  /// The same at the end of the scan; `objectness` replaces what was stored. Error: also if other programs
  /// removed or replaced files of the session meanwhile, though they were written again.
  [[nodiscard]] Result<void> finish(MappingPipeline& pipeline, const ObjectCollector& collector,
                                    SavedObjectness objectness);
  /// Error: other programs removed, moved or replaced files of the session since it was opened.
  [[nodiscard]] Result<void> findDisturbance();
  /// The frames with stored images, in order. Waits until they are on
  /// disk. Error: they cannot be read.
  [[nodiscard]] Result<std::vector<StoredFrame>> storedFrames();
  [[nodiscard]] std::filesystem::path folder() const { return writer_->folder(); }
  /// Sets a region's object when there is no catalogue. None: it is no object.
  void setObject(RegionId region, ObjectId object) { objects_[region] = object; }
  [[nodiscard]] ObjectId objectOf(RegionId region) const;
  [[nodiscard]] const std::map<RegionId, ObjectId>& objects() const { return objects_; }
  void setObjects(std::map<RegionId, ObjectId> objects) { objects_ = std::move(objects); }
  /// On disk the session is as in `on_disk`, whatever resume() was given: regions, metadata and the states
  /// of frames that `now` has differently are saved again. Both have the same frames.
  void rewriteFrom(const SavedScan& on_disk, const SavedScan& now);
  /// Metadata to store with the next save.
  void setMetadata(const std::string& name, const std::string& value) { setup_.metadata[name] = value; }
  /// The same, stored immediately. Error: writing failed.
  [[nodiscard]] Result<void> keepMetadata(const std::string& name, const std::string& value);
  /// The catalogue of the objects that this scan finds.
  void setCatalogue(const std::string& identity);
  /// Why the session could not be written, once for each series of failures.
  [[nodiscard]] std::optional<Error> takeFailure() { return writer_->takeFailure(); }

 private:
  /// By position.
  using HandedPages = std::vector<std::pair<Eigen::Vector3i, StoredPage>>;

  /// Everything but the map.
  [[nodiscard]] SavedDelta collect(MappingPipeline& pipeline, const ObjectCollector* collector);
  void collectRegions(MappingPipeline& pipeline, const ObjectCollector* collector, SavedDelta& delta);
  void collectNamings(const ObjectCollector& collector, SavedDelta& delta);
  /// The catalogue's data about the objects.
  void collectObjects(const MappingPipeline& pipeline, const ObjectCollector& collector, SavedDelta& delta);
  /// Fills pages_ with the pages of the map that changed since they were handed over.
  void beginPages(const BrickMap& bricks);
  /// Hands over so many bricks of pages_, in whole pages. True: those were the last.
  [[nodiscard]] bool handSomePages(BrickMap& bricks, std::size_t enough);
  /// Hands over all other changes after the last pages, which makes them part of the session.
  void endPages(MappingPipeline& pipeline, const ObjectCollector* collector);
  /// Whether the maximum number of pages waits for the disk.
  [[nodiscard]] bool arePagesWaiting();
  void hand(SavedDelta delta);
  /// Applies while there are few frames.
  void keepFirst(const SavedFrame& frame);
  /// Whether the frame's images belong to the session. Where frames have colour, only those are chosen,
  /// because exports and views need it.
  [[nodiscard]] bool isKeyFrame(const RgbdFrame& frame, const FrameResult& result);

  std::unique_ptr<SessionWriter> writer_;
  Setup setup_;
  struct KnownFrame {
    int number;  // SavedFrame::number
    std::optional<Intrinsics> intrinsics;
  };
  std::map<int, KnownFrame> known_frames_;  // by index of the source, for frames that may be integrated late
  ColorPresence color_;                     // in usable frames
  std::vector<SavedFrame> first_usable_;    // those that restart() would drop
  std::vector<SavedFrame> frames_;          // not handed over yet
  std::vector<SavedRecording> recordings_;  // not handed over yet
  std::vector<int> voxels_;                 // of each fragment, as handed over
  std::vector<ViewCoverage> seen_from_;     // as handed over
  std::vector<SupportPixels> support_pixels_;  // as handed over
  std::map<RegionId, SavedRegion> regions_;
  std::map<RegionId, ObjectId> objects_;     // when no catalogue provides them
  std::map<RegionId, std::string> namings_;  // as handed over
  RememberedObjects remembered_;             // as handed over
  std::string catalogue_;                    // identity
  std::vector<int> pages_;                   // of the map, to hand over; the next one last
  std::vector<std::weak_ptr<const HandedPages>> handed_pages_;
  bool saves_pages_ = false;
  std::uint64_t view_ = 0;       // of the map: pages in view later are not part of the session
  std::uint64_t next_view_ = 0;  // the same, once all of pages_ are
  std::chrono::steady_clock::time_point last_handed_;
  std::chrono::steady_clock::time_point last_save_;
};

}  // namespace scantrove
