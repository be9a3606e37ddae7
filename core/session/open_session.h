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

/// A region of a session, as listed.
struct RegionSummary {
  RegionId region;
  std::int64_t voxels = 0;  ///< near the surface
  Eigen::Vector3f centroid_world = Eigen::Vector3f::Zero();
  Eigen::AlignedBox3f box_world;
  RegionNote note;
  RegionLabel label;
  bool is_proposed_background = false;  ///< isProposedBackground()
  ViewCoverage seen_from;               ///< by the camera
};

/// A session that is viewed, edited and exported without a camera. Operations are on disk when they return.
/// One thread. More than thirty functions: half of them forward requests of command line, window and
/// exports to the parts of a saved scan.
class OpenSession {
 public:
  /// `device`: as for chooseDevice. Error: no session, another program has it open, no device, ...
  [[nodiscard]] static Result<std::unique_ptr<OpenSession>> open(const std::filesystem::path& folder,
                                                                 const std::string& device = "");
  ~OpenSession();

  [[nodiscard]] const SessionSetup& setup() const { return setup_; }
  [[nodiscard]] const std::vector<SavedFrame>& frames() const { return scan_.frames; }
  [[nodiscard]] const std::vector<SavedRecording>& recordings() const { return scan_.recordings; }
  [[nodiscard]] const std::vector<SavedKeyFrame>& keyFrames() const { return scan_.key_frames; }
  /// The frame of a key frame; null: no longer known.
  [[nodiscard]] const SavedFrame* frameOf(const SavedKeyFrame& key_frame) const;
  /// The depth camera of a frame.
  [[nodiscard]] Intrinsics intrinsicsOf(const SavedFrame& frame) const {
    return frame.intrinsics.value_or(setup_.K);
  }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Sentences about unreadable data.
  [[nodiscard]] const std::vector<std::string>& damages() const { return damages_; }
  /// Whether the scan reached its end.
  [[nodiscard]] bool hasEnded() const { return !metadata("ended").empty(); }
  /// Whether the files beside the session (cloud, label map and images) show its current regions; none: no
  /// such files, or unknown.
  [[nodiscard]] std::optional<bool> areResultsCurrent() const;

  /// Whether the scan's refinement is still to be done.
  [[nodiscard]] bool canBeRefined() const;

  /// All regions, by id. Error: the device failed.
  [[nodiscard]] Result<std::vector<RegionSummary>> regions();

  /// The surface at a pixel of a frame.
  struct SurfacePoint {
    RegionId region;  ///< none: unlabelled surface
    Eigen::Vector3f point_world = Eigen::Vector3f::Zero();
  };
  /// `frame`: index in its source; x, y: of the depth image, as in label images. Error: no such frame, no
  /// pose, pixel outside, or no surface. In a key frame the region is the one that a person painted there.
  [[nodiscard]] Result<SurfacePoint> at(int frame, int x, int y);

  /// Each operation is written atomically before it returns, with its pending catalogue edits (for
  /// applyToCatalogue). A paint also needs the images of its key frame. Error: see RegionEditor and
  /// paintedSurfaceOf; or writing failed: then it holds until the program ends.
  [[nodiscard]] Result<RegionEditor::Outcome> edit(const Operation& operation);
  [[nodiscard]] Result<RegionEditor::Outcome> undo();
  [[nodiscard]] Result<RegionEditor::Outcome> redo();
  [[nodiscard]] const OperationLog& history() const;
  [[nodiscard]] const RegionNote& noteOf(RegionId region) const;
  /// The region's object in the session's catalogue; none: unknown.
  [[nodiscard]] ObjectId objectOf(RegionId region) const;
  /// The label of the region, as of the last reading of the catalogue; empty without labels.
  [[nodiscard]] RegionLabel labelOf(RegionId region) const;
  /// Labels of all regions that have one.
  [[nodiscard]] const std::map<RegionId, RegionLabel>& labels() const { return labels_; }
  /// Reads the current state of the objects from the catalogue; regions() includes this.
  void readCatalogue();
  /// All classes of the catalogue, as of its last reading; empty: it is missing.
  [[nodiscard]] ClassTable classes() const { return catalogue_ ? catalogue_->classes() : ClassTable(); }
  /// Marks the catalogue as missing: labels come from the session's copy.
  [[nodiscard]] const std::optional<Error>& missingCatalogue() const { return missing_catalogue_; }
  /// From now on object ids belong to this catalogue. Ids of another one are set aside, and restored with
  /// it (turnTo). Stored with the next edit. Returns whether any were set aside.
  [[nodiscard]] Result<bool> useCatalogue(ObjectDatabase& database);
  /// Metadata for this program, by name; empty: none.
  [[nodiscard]] std::string metadata(const std::string& name) const;
  void setMetadata(const std::string& name, const std::string& value);
  /// Writes metadata. Error: writing failed.
  [[nodiscard]] Result<void> saveMetadata();
  /// Operations no longer apply to the catalogue.
  void omitCatalogue() { has_catalogue_ = false; }
  /// Operations that are pending in the catalogue, oldest first.
  [[nodiscard]] std::vector<PendingEdit> pendingEdits() const;
  /// The catalogue has executed the oldest pending edit: stores that with its results atomically. Error:
  /// writing failed.
  [[nodiscard]] Result<void> completeEdit(const SessionMetadata& metadata,
                                          const std::map<RegionId, ObjectId>& objects);
  /// Memory of the map.
  [[nodiscard]] int brickCount() const;
  /// Problems with the session's files that were repaired or are waiting; none: nothing new.
  [[nodiscard]] std::optional<Error> takeFailure();
  /// Error: other programs removed, moved or replaced files of the session since it was opened.
  [[nodiscard]] Result<void> findDisturbance();

  [[nodiscard]] MappingPipeline& pipeline() { return *pipeline_; }

 private:
  explicit OpenSession(std::filesystem::path folder);
  [[nodiscard]] const SavedFrame* frameAt(int source_index) const;
  [[nodiscard]] Result<RegionEditor::Outcome> keep(Result<RegionEditor::Outcome> outcome,
                                                   EditDirection direction);
  /// Objects follow joined regions, and return with an undo.
  void joinObjects(const RegionEditor::Outcome& outcome, EditDirection direction);
  /// The catalogue's data about the region's object, else the session's copy.
  [[nodiscard]] RegionObject regionObjectOf(RegionId region, const RememberedObjects& remembered) const;
  /// Copies the catalogue's current data about the objects into the session.
  void rememberObjects();
  /// Resumes edits that an interruption kept from the catalogue.
  void completePendingEdits();

  std::filesystem::path folder_;
  SessionSetup setup_;
  SavedScan scan_;
  std::vector<std::string> damages_;
  std::optional<CatalogueModel> catalogue_;  // none: missing
  std::map<RegionId, RegionObject> region_objects_;
  std::map<RegionId, RegionLabel> labels_;
  std::optional<Error> missing_catalogue_;
  bool has_catalogue_ = true;  // operations apply to it
  std::unique_ptr<ComputeContext> compute_;
  std::unique_ptr<MappingPipeline> pipeline_;
  std::unique_ptr<SessionRecorder> recorder_;
};

}  // namespace scantrove
