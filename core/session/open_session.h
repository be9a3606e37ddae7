#pragma once
#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/editing/region_editor.h"
#include "core/geometry/view_coverage.h"
#include "core/session/pending_edits.h"
#include "core/session/region_label.h"
#include "core/session/saved_scan.h"
#include "core/session/session_setup.h"

namespace scantrove {

class ComputeContext;
class MappingPipeline;
class ObjectDatabase;
class SessionRecorder;

/// A region of a session, as a list shows it.
struct RegionSummary {
  RegionId region;
  std::int64_t voxels = 0;  ///< near the surface
  Eigen::Vector3f centroid_world = Eigen::Vector3f::Zero();
  Eigen::AlignedBox3f box_world;
  RegionNote note;
  RegionLabel label;
  ViewCoverage seen_from;  ///< by the camera
};

/// A session that is looked at, edited and exported without a camera. What an operation changed is on disk
/// when it returns. One thread. More than thirty functions: half of them hand on what command line, window
/// and exports ask of the parts of a saved scan.
class OpenSession {
 public:
  /// `device`: as chooseDevice takes it. Error: there is none, another program has it, no device, ...
  [[nodiscard]] static Result<std::unique_ptr<OpenSession>> open(const std::filesystem::path& folder,
                                                                 const std::string& device = "");
  ~OpenSession();

  [[nodiscard]] const SessionSetup& setup() const { return setup_; }
  [[nodiscard]] const std::vector<SavedFrame>& frames() const { return scan_.frames; }
  [[nodiscard]] const std::vector<SavedRecording>& recordings() const { return scan_.recordings; }
  [[nodiscard]] const std::vector<SavedKeyFrame>& keyFrames() const { return scan_.key_frames; }
  /// The frame that a key frame shows; null: it is not known any more.
  [[nodiscard]] const SavedFrame* frameOf(const SavedKeyFrame& key_frame) const;
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// What could not be read, in sentences.
  [[nodiscard]] const std::vector<std::string>& damages() const { return damages_; }
  /// Whether the scan came to its end.
  [[nodiscard]] bool hasEnded() const { return !fact("ended").empty(); }
  /// Whether the files beside the session (cloud, label map and images) show its regions as they are now;
  /// none: there are no such files, or it is not known.
  [[nodiscard]] std::optional<bool> areResultsCurrent() const;

  /// Whether the scan's refinement is left to be done.
  [[nodiscard]] bool canBeRefined() const;

  /// All regions, by id. Error: the device failed.
  [[nodiscard]] Result<std::vector<RegionSummary>> regions();

  /// What a pixel of a frame shows.
  struct Place {
    RegionId region;  ///< none: surface without a label
    Eigen::Vector3f point_world = Eigen::Vector3f::Zero();
  };
  /// `frame`: index in its source; x, y: of the depth image, as in label images. Error: no such frame, it has
  /// no pose, the pixel lies outside, or shows no surface.
  [[nodiscard]] Result<Place> at(int frame, int x, int y);

  /// Each is written as a whole before it returns, with what it has to do in the catalogue (applyToCatalogue
  /// does that). Error: see RegionEditor; or it could not be written: then it holds until the program ends.
  [[nodiscard]] Result<RegionEditor::Outcome> edit(const Operation& operation);
  [[nodiscard]] Result<RegionEditor::Outcome> undo();
  [[nodiscard]] Result<RegionEditor::Outcome> redo();
  [[nodiscard]] const OperationLog& history() const;
  [[nodiscard]] const RegionNote& noteOf(RegionId region) const;
  /// The object that the region is, of the session's catalogue; none: not known.
  [[nodiscard]] ObjectId objectOf(RegionId region) const;
  /// What is to be said of the region, as of the last reading of the catalogue; nothing of one without
  /// labels.
  [[nodiscard]] RegionLabel labelOf(RegionId region) const;
  /// Of all regions that there is something to say of.
  [[nodiscard]] const std::map<RegionId, RegionLabel>& labels() const { return labels_; }
  /// Reads what the catalogue says of the objects now; regions() does so by itself.
  void readCatalogue();
  /// Says that the catalogue is not there, and its words are those that the session kept.
  [[nodiscard]] const std::optional<Error>& missingCatalogue() const { return missing_catalogue_; }
  /// Numbers of objects are those of this catalogue from now on: those of another one are set aside, and come
  /// back with it (turnTo). Kept with the next edit. Whether any were set aside.
  [[nodiscard]] Result<bool> useCatalogue(ObjectDatabase& database);
  /// A note for this program itself, by name; empty: there is none.
  [[nodiscard]] std::string fact(const std::string& name) const;
  void setMetadata(const std::string& name, const std::string& value);
  /// Writes them. Error: they could not be written.
  [[nodiscard]] Result<void> saveMetadata();
  /// Operations are not for the catalogue from now on.
  void omitCatalogue() { has_catalogue_ = false; }
  /// What operations have still to do in the catalogue, oldest first.
  [[nodiscard]] std::vector<PendingEdit> pendingEdits() const;
  /// The catalogue has carried out the oldest: that, and what it said, is written in one piece. Error: it
  /// could not be written.
  [[nodiscard]] Result<void> completeEdit(const SessionMetadata& metadata,
                                          const std::map<RegionId, ObjectId>& objects);
  /// Of the map.
  [[nodiscard]] int brickCount() const;
  /// What went wrong with the session's files and was mended, or waits; none: nothing new.
  [[nodiscard]] std::optional<Error> takeFailure();
  /// Error: other programs removed, moved or replaced files of the session since it was opened.
  [[nodiscard]] Result<void> findDisturbance();

  [[nodiscard]] MappingPipeline& pipeline() { return *pipeline_; }

 private:
  explicit OpenSession(std::filesystem::path folder);
  [[nodiscard]] const SavedFrame* frameAt(int source_index) const;
  [[nodiscard]] Result<RegionEditor::Outcome> keep(Result<RegionEditor::Outcome> outcome,
                                                   EditDirection direction);
  /// Objects go with regions that are joined, and come back with an undo.
  void joinObjects(const RegionEditor::Outcome& outcome, EditDirection direction);
  /// What the catalogue has of the region's object, else what the session kept of it.
  [[nodiscard]] RegionObject regionObjectOf(RegionId region, const RememberedObjects& remembered) const;
  /// Keeps what the catalogue says of the objects now.
  void rememberObjects();
  /// What an interruption kept from the catalogue.
  void completePendingEdits();

  std::filesystem::path folder_;
  SessionSetup setup_;
  SavedScan scan_;
  std::vector<std::string> damages_;
  std::optional<CatalogueModel> catalogue_;  // none: it is not there
  std::map<RegionId, RegionObject> region_objects_;
  std::map<RegionId, RegionLabel> labels_;
  std::optional<Error> missing_catalogue_;
  bool has_catalogue_ = true;  // that operations are for
  std::unique_ptr<ComputeContext> compute_;
  std::unique_ptr<MappingPipeline> pipeline_;
  std::unique_ptr<SessionRecorder> recorder_;
};

}  // namespace scantrove
