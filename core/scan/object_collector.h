#pragma once
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/capture/color_projection.h"
#include "core/capture/rgbd_frame.h"
#include "core/catalogue/catalogue_mirror.h"
#include "core/catalogue/catalogue_writer.h"
#include "core/catalogue/object_database.h"
#include "core/catalogue/stored_namings.h"
#include "core/discovery/candidate.h"
#include "core/fusion/depth_view.h"
#include "core/fusion/rendered_view.h"
#include "core/scan/frame_objects.h"
#include "core/scan/kept_view.h"
#include "core/scan/met_objects.h"
#include "core/scan/recognition_history.h"
#include "core/scan/region_label.h"
#include "core/scan/scan_report.h"
#include "core/tracking/pose_estimate.h"

namespace scantrove {

/// Turns candidates into objects of the catalogue (thesis 5.1.1, 5.2 and ch. 6). A candidate is looked up
/// several times before it counts as known or unknown; of those that share regions the one that the catalogue
/// and its outline speak for is taken. What is whole and unknown is added; then new directions of view are
/// kept. Follows what persons and other programs do to the catalogue meanwhile: what was deleted is not added
/// again by this scan, what was merged is one. One thread, the worker's; may throw cl::Error.
///
/// No call but create(), settle() and finish() waits for the database: what is found counts at once, another
/// thread stores it, and a later call says so.
///
/// Regions are remembered with the object that they were taken for. Who holds that object now, after merges
/// and deletions, is asked anew each time (CatalogueMirror::mergeRootOf), so that whatever is undone is
/// undone here too.
class ObjectCollector {
 public:
  /// Candidates that are looked up in one frame at most: bounds what it takes.
  static constexpr std::size_t kMaxObservations = 4;

  /// Loads all views of `database`, which is needed no longer than that, into the detector, and starts to
  /// write into the catalogue of `writer`, which is the same one.
  /// `memory`: of CollectorMemory, for a scan that continues; empty: of none. Error: also a catalogue that is
  /// another one than the memory's.
  [[nodiscard]] static Result<std::unique_ptr<ObjectCollector>> create(
      ComputeContext& compute, ObjectDatabase& database, CatalogueWriter::Options writer,
      const DetectionParams& params, std::span<const std::uint32_t> memory = {});

  /// Candidates of one frame, which may share regions; `in_color` at their resolution. What was stored since
  /// the last call and that the catalogue fails is part of the outcome; it ends nothing.
  [[nodiscard]] FrameObjects collect(const RgbdFrame& frame, const PoseEstimate& pose,
                                     const SurfaceInColor& in_color, std::vector<Candidate> candidates);

  /// What the next frame to be collected shows, whether it is a candidate or not: an object whose regions are
  /// in view is not met under others.
  void setRegionsInView(std::vector<RegionId> regions) { in_view_ = std::move(regions); }

  /// Who joined two regions: what frames say may be otherwise in the next.
  enum class JoinedBy { person, frames };
  /// The region `from` is now part of `into`. When they were two objects, collect() makes them one in the
  /// catalogue, unless persons said what each is, or took such a merge back; where frames joined them, once
  /// the join has held for kFramesToBeOne frames or to the end of the scan. Where `into` was none, it is the
  /// object of `from` if a person joined them or spoke of that; else only the place tells
  /// (MetObjects::nearby).
  void regionsJoined(RegionId into, RegionId from, JoinedBy by = JoinedBy::person);
  static constexpr int kFramesToBeOne = 300;
  /// `part` was a part of `from` until now. What a person deleted stays so in its parts.
  void regionsParted(RegionId from, RegionId part);

  /// Objects whose place this frame, the last one given to collect(), shows empty may be met elsewhere from
  /// now on. `depth_noise_m`: FusionParams.
  void lookForThoseMet(const DepthView& now, float depth_noise_m) {
    met_.lookAtPlaces(now, depth_noise_m, frame_);
  }

  /// A person says that the candidate with this region is an object. Where it is none yet, it is added when
  /// it is seen next, complete or not; with a `name`, it gets that then. `name` is what the region is called
  /// by now.
  void want(RegionId region, const std::string& name);
  /// A person says that it is none, or has nothing more to say of it.
  void wantNoMore(RegionId region);
  /// Regions that are waited for.
  [[nodiscard]] const std::map<RegionId, std::string>& requested() const { return wanted_; }

  /// A person calls the region so: its object gets the name, and is confirmed; where the catalogue has one of
  /// that name, the two are one from then on. Where it is no object, want() makes it one.
  void nameByPerson(RegionId region, const std::string& name);
  /// The same for one that was taken back. What others had made of its object meanwhile stays.
  void nameAgain(RegionId region, const std::string& name);
  /// The newest such saying is taken back: what it did to the catalogue, unless somebody has said otherwise
  /// since.
  void takeNameBack(RegionId region, const std::string& name);
  /// A person takes back that the region is an object: one that was made for that goes.
  void takeObjectBack(RegionId region);
  /// What namings of earlier scans of this session did, so that they can be taken back here.
  void restoreNamings(RegionId region, const std::vector<StoredNaming>& kept);
  /// Whether this scan named the region so, and has not taken it back.
  [[nodiscard]] bool hasNamed(RegionId region, const std::string& name) const;
  /// What namings of regions did, here and in earlier scans, as far as it is stored and not taken back.
  [[nodiscard]] std::map<RegionId, std::vector<StoredNaming>> storedNamings() const;
  /// All of these are one object.
  [[nodiscard]] bool areOneObject(const RegionSet& regions) const;

  /// Adds those of the candidates that are waited for, as one frame shows them, outside of its course.
  [[nodiscard]] FrameObjects addWanted(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
                                       const SurfaceInColor& in_color,
                                       const std::vector<Candidate>& candidates);

  // At the end of a scan, when regions do not change any more: begin; settle what is complete; judge the
  // views of all framesOfViews(); collect() from the key frames; begin the last looks; collect() from the
  // frames that it names; end.

  void beginLookingAgain();
  /// Regions that are one complete object, and the frame (RgbdFrame::index) that shows it best.
  struct CompleteSet {
    RegionSet regions;
    int best_frame = 0;
  };
  /// From now on the scene consists of the `complete` sets, which are disjoint, most likely first. A tracked
  /// object follows its regions into one of them. `is_unlikely`: the region is no part of a complete object:
  /// the views of an object of such regions alone are dropped, unless a user has edited it.
  void settleComplete(std::span<const CompleteSet> complete,
                      const std::function<bool(RegionId)>& is_unlikely);
  /// Frames (RgbdFrame::index) of which this scan kept views, rising.
  [[nodiscard]] std::vector<int> framesOfViews() const;
  /// Of wholes that are settled: they are one, or wanted.
  [[nodiscard]] bool mayBeObject(const RegionSet& regions) const;
  /// The region was taken for an object that a person spoke of or deleted, or that is not of this scan alone.
  [[nodiscard]] bool staysAsItIs(RegionId region) const {
    const ObjectId object = met_.objectOf(region);
    return object && staysAsItIs(object);
  }
  /// Where that frame was taken, and the size of the image that some views of it are of.
  struct ViewsCamera {
    cv::Size image_px;
    Eigen::Isometry3d T_world_camera;
  };
  /// Of each size in which views of that frame were kept.
  [[nodiscard]] std::vector<ViewsCamera> camerasOfViews(int frame_index) const;
  /// All frames were collected from; now those (RgbdFrame::index), once more, that show best what is a whole
  /// and no object yet, or one without a view. It becomes one then, or has one.
  [[nodiscard]] std::vector<int> beginLastLooks();
  /// Views of that frame, of images as large as `now`, that show their objects otherwise than the map does
  /// now count no longer. Where most of what a view shows has been taken away since, it counts, unless the
  /// object is there all the same. `now`: what the map shows from there; `depth_noise_m`: FusionParams.
  void judgeViewsOf(int frame_index, const RenderedView& now, float depth_noise_m);
  /// Those views leave the catalogue, and with them the objects that they were all of.
  void endLookingAgain();

  /// The region is that object of the catalogue, as an earlier scan of this map found out.
  void bind(RegionId region, ObjectId object) { met_.bind({region}, catalogue_.keyOf(object)); }

  /// Learns what happened to the catalogue since the last call, and asks for more; collect() does so by
  /// itself.
  [[nodiscard]] FrameObjects followCatalogue();
  /// Waits until all that was found is stored, and all that others did has been heard of: followCatalogue()
  /// says so. False: not within `limit`.
  [[nodiscard]] bool settle(std::chrono::milliseconds limit) { return writer_->settle(limit); }
  /// Stores what waits and ends the session; `announce` hears what is stored, and that the catalogue fails,
  /// as it happens. Nothing is collected afterwards. Error: what the catalogue has not got, and why.
  [[nodiscard]] Result<void> finish(const std::function<void(const FrameObjects&)>& announce);
  void setParams(const DetectionParams& params);

  /// Objects met in this scan that the catalogue has, by id.
  [[nodiscard]] std::vector<ScanReport::Object> metObjects() const;
  /// The object that a region is, or none: unknown, not stored yet, or deleted by a person.
  [[nodiscard]] ObjectId objectOf(RegionId region) const;
  /// The same with what the catalogue says of it.
  [[nodiscard]] RegionObject describeRegion(RegionId region) const;
  /// The record of an object of the catalogue.
  [[nodiscard]] std::optional<ObjectRecord> record(ObjectId object) const;
  /// Fills in the object of `seen.regions` as it is called now.
  void describeObject(SeenObject& seen) const;

 private:
  friend class CollectorMemory;
  /// One frame as cut up into views.
  struct Look {
    const RgbdFrame& frame;
    const Eigen::Isometry3d& T_world_camera;
    const SurfaceInColor& in_color;
    FrameObjects& objects;
  };

  ObjectCollector(Detector detector, const DetectionParams& params);

  /// Applies what has arrived.
  void takeNews(FrameObjects& objects);
  enum class Which { held, all };
  void mergeJoined(Which which = Which::held);
  [[nodiscard]] bool shouldMerge(ObjectId a, ObjectId b) const;
  void lookUpDue(const std::vector<Candidate>& candidates, const Look& look);
  void lookUp(const std::vector<const Candidate*>& candidates, const Look& look);
  /// Objects of the catalogue that were taken away from where they stood.
  [[nodiscard]] std::vector<ObjectId> missingObjects() const;
  /// One of the `objects` has this holder.
  [[nodiscard]] bool isHeldWith(ObjectId root, const std::set<ObjectId>& objects) const;
  /// It does not stand any more where it did when the scan began to see it.
  [[nodiscard]] bool hasMoved(ObjectId object) const;
  /// The match of a look at something that came, of `missing` objects perhaps one.
  [[nodiscard]] DetectionMatch orBack(DetectionMatch match, std::size_t missing);
  /// Finds out whether earlier scans saw this place, by where what was recognised stands.
  void alignWithEarlierScans();
  /// What earlier scans saw where the candidate is, about as large, and this one has not met yet.
  [[nodiscard]] std::vector<ObjectId> expectedAt(const Candidate& candidate) const;
  /// The match of a look at what may be what is to be expected there.
  [[nodiscard]] static DetectionMatch orExpected(DetectionMatch match);
  /// What stands where it is expected is that, if it looks no more different: two things of one size that
  /// have little in common differ by 0.8 and more, most by 1. On the halves of 17 random scenes that knows
  /// 213 of 230 things again, 178 without places, and takes one more for another (3 for 2).
  static constexpr float kExpectedDistance = 0.8F;
  void lookAmongThoseThatCame(const std::vector<Candidate>& candidates, const Look& look);
  /// The object that this candidate is, as far as is known; nothing is bound to it yet.
  [[nodiscard]] ObjectId identityOf(const Candidate& candidate) const;
  /// The object that stood where the candidate is, and that may be it.
  [[nodiscard]] ObjectId nearby(const Candidate& candidate) const;
  /// Another region than these that is in view is the object.
  [[nodiscard]] bool isInViewBeside(ObjectId object, const RegionSet& regions) const;
  [[nodiscard]] std::vector<std::size_t> choose(const std::vector<Candidate>& candidates,
                                                const std::vector<ObjectId>& identities) const;
  void collectOne(const Candidate& candidate, ObjectId identity, const Look& look);
  /// A clear look at what is taken for `object`, and is not as large. After some in a row that is not it.
  void doubt(const Candidate& candidate, ObjectId object);
  /// The new `object` stands where the doubted one was thought to stand. Where that one is nowhere else its
  /// views showed something that is none, or the same: the map tells when the scan has ended.
  void takePlaceOf(ObjectId doubted, ObjectId object);
  /// What took the place of a doubted object in the end; of another the object itself.
  [[nodiscard]] ObjectId successorOf(ObjectId object) const;
  /// They are held as one, or took the place of one another, and a person did not delete that.
  [[nodiscard]] bool haveOneSuccessor(ObjectId a, ObjectId b) const;
  /// What took the place of a doubted object, and is what that one's views show, is the same object.
  void mergeSuccessors();
  [[nodiscard]] bool isDoubted(const RegionSet& regions, ObjectId object) const;
  void joinDoubles(const std::vector<const Candidate*>& chosen);
  /// They, or what they are held with, were seen in one frame.
  [[nodiscard]] bool areSideBySide(ObjectId a, ObjectId b) const;
  [[nodiscard]] bool isWanted(const RegionSet& regions) const;
  /// It is the region alone that a person waits for, and what the person calls it; none: no.
  [[nodiscard]] const std::string* wantedName(const Candidate& candidate) const;
  /// The object that the region is bound to and that is there; none: no.
  [[nodiscard]] ObjectId boundTo(RegionId region) const;
  /// Its object is called otherwise, by another of its regions.
  [[nodiscard]] bool isCalledOtherwise(RegionId region, const std::string& name) const;
  void nameObject(RegionId region, ObjectId object, const std::string& name, ObjectId earlier, ObjectId made);
  void nameByPerson(RegionId region, const std::string& name, int again);
  /// `from` is now part of `into`.
  void followWanted(RegionId into, RegionId from);
  enum class MadeFor { itself, wish };
  /// What was waited for is there; `made`: whether the object was made for that alone.
  void fulfil(const Candidate& candidate, ObjectId object, MadeFor made);
  void addToCatalogue(const Candidate& candidate, const Look& look, MadeFor made);
  /// The object is another whole than these regions, and nobody says that the two are one. Before the wholes
  /// are settled: no.
  [[nodiscard]] bool isOfAnotherWhole(ObjectId object, const RegionSet& regions) const;
  /// A view of it still counts, as far as is known; or that is not for this scan to say.
  [[nodiscard]] bool hasView(ObjectId object) const;
  /// What this scan took for new, but is clearly like an object of an earlier scan that it has not met, is
  /// that one.
  void lookAmongThoseOfBefore(const std::vector<const Candidate*>& chosen, const Look& look);
  /// It is a whole, and no look will show that better.
  [[nodiscard]] bool isLastLook(const Candidate& candidate, const Look& look) const;
  /// The wholes take the objects that their regions were taken for, each one, and none that another has.
  void bindComplete(std::span<const CompleteSet> complete);
  /// A person said something of it, or deleted it.
  [[nodiscard]] bool isByPerson(ObjectId object) const;
  /// That, or it is not of this scan alone.
  [[nodiscard]] bool staysAsItIs(ObjectId object) const;
  void keepNewDirection(ObjectId object, const Candidate& candidate, const Look& look);
  [[nodiscard]] const ObjectRecord* recordOf(ObjectId root) const { return catalogue_.record(root); }
  /// None: the colour image does not show it.
  [[nodiscard]] static std::optional<ObjectView> viewToKeep(const Candidate& candidate, const Look& look);
  [[nodiscard]] bool isMet(ObjectId root) const;
  /// `image_px`: of the image that the candidate was seen in.
  void noteKept(const ObjectView& view, const Candidate& candidate, const RgbdFrame& frame,
                const cv::Size& image_px);
  [[nodiscard]] bool isOutdated(const KeptView& view, const RenderedView& now) const;
  /// As far as is known, the object is about as large as this look shows it.
  [[nodiscard]] bool isAlike(const ObjectRecord& known, const Candidate& candidate, const Look& look) const;
  /// No view of the object shows it about as large, from wherever.
  [[nodiscard]] bool isOfOtherSize(const ObjectRecord& known, const Candidate& candidate) const;

  CatalogueMirror catalogue_;  // objects are known by its keys
  std::unique_ptr<CatalogueWriter> writer_;
  DetectionParams params_;

  MetObjects met_;
  std::vector<RegionId> in_view_;
  RecognitionHistory recognition_;
  std::map<RegionId, std::string> wanted_;  // by a person, not added yet; names, or empty
  /// What a person said of an object by naming a region, or by saying that it is one.
  struct Naming {
    int number = 0;
    RegionId region;
    std::string name;  // empty: it is an object
    ObjectId earlier;  // what the region was before, where it is another object now
    ObjectId made;     // for this alone; none: it was there
    std::optional<ObjectNaming> stored = {};
    bool is_of_before = false;  // of an earlier scan
  };
  void takeBack(std::vector<Naming>::iterator naming);
  /// An object that was made for something which a person took back is none any more.
  void withdraw(ObjectId made);
  void noteStored(const news::NameStored& news);
  std::vector<Naming> namings_;  // that are not taken back
  std::vector<Naming> undone_;   // taken back, the newest last
  int last_naming_ = 0;
  std::map<RegionId, ObjectId> not_these_;  // a person said that the region is another than that
  std::vector<Error> refusals_;             // to be told
  std::vector<ObjectRecord> known_again_;   // what was taken for new is that; to be told
  /// Objects whose regions were joined, or that stand at one place.
  struct Joined {
    ObjectId kept, gone;
    RegionId region;  ///< that holds both; none: they are one for good
    int frame = 0;
  };
  std::vector<Joined> joined_;
  /// What the regions were taken for, and looks since then that show that they are not.
  struct Doubt {
    ObjectId object;
    int observations = 0;
    int last_frame = 0;
  };
  std::map<RegionSet, Doubt> doubts_;
  std::map<ObjectId, ObjectId> successor_;                // of doubted ones: what took their places
  std::set<std::pair<ObjectId, ObjectId>> side_by_side_;  // seen in one frame; smaller id first
  std::vector<KeptView> kept_views_;
  std::set<ObjectId> by_person_;  // that a person waited for
  std::set<ObjectId> back_;       // that something which came was recognised as
  std::set<ObjectId> moved_;      // that were met elsewhere than before
  /// New ones that came into the scene; how often each missing one was held against them.
  std::map<ObjectId, std::map<ObjectId, int>> appeared_;
  bool is_looking_again_ = false;
  std::map<RegionSet, int> wholes_;     // and the frames (RgbdFrame::index) that show them best
  std::map<ObjectId, int> looks_back_;  // by object: looks that were held against those of before
  bool are_last_looks_ = false;
  int frame_ = 0;
};

}  // namespace scantrove
