#pragma once
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "core/catalogue/catalogue_mirror.h"
#include "core/catalogue/catalogue_writer.h"
#include "core/collection/identity_resolver.h"
#include "core/collection/object_tracks.h"
#include "core/collection/observed_frame.h"
#include "core/collection/stored_view.h"
#include "core/collection/user_requests.h"
#include "core/fusion/rendered_view.h"

namespace scantrove {

/// Adds objects and views to the catalogue, and knows the views of this scan. Refinement compares each view
/// with the map and removes views that no longer show their object.
class ViewKeeper {
 public:
  /// All outlive this. `views`: those that this scan has added so far.
  ViewKeeper(CatalogueMirror& catalogue, CatalogueWriter& writer, ObjectTracks& tracks,
             const UserRequests& requests, const IdentityResolver& identities,
             std::vector<StoredView> views = {});
  [[nodiscard]] const std::vector<StoredView>& all() const { return views_; }
  void setParams(const DetectionParams& params) { params_ = params; }
  [[nodiscard]] const DetectionParams& params() const { return params_; }

  /// Adds the candidate as a new object with its first view. None: the colour image does not show it, or
  /// the catalogue has no room now.
  [[nodiscard]] ObjectId addObject(const Candidate& candidate, const ObservedFrame& observed);
  /// Adds a view of the object if no stored view has a similar direction.
  void addView(ObjectId object, const Candidate& candidate, const ObservedFrame& observed);
  /// Adds a view of the object. False: the colour image does not show it, or the catalogue has no room now.
  [[nodiscard]] bool storeView(ObjectId object, const Candidate& candidate, const ObservedFrame& observed);
  /// How well a view of the candidate from that frame would show it.
  [[nodiscard]] static ViewQuality qualityOf(const Candidate& candidate, const ObservedFrame& observed);

  /// Whether the object is about as large as this candidate, as far as known.
  [[nodiscard]] bool matchesSize(const ObjectRecord& known, const Candidate& candidate,
                                 const ObservedFrame& observed) const;
  /// The complete object has another size than this candidate, and no view from any direction shows it
  /// about as large.
  [[nodiscard]] bool contradictsSize(const ObjectRecord& known, const Candidate& candidate) const;
  /// The object has a valid view, or refinement does not change it.
  [[nodiscard]] bool hasView(ObjectId object) const;

  // Refinement.

  /// Frames (RgbdFrame::index) with stored views, ascending.
  [[nodiscard]] std::vector<int> framesOfViews() const;
  /// The pose of that frame, and the size of the image that some of its views come from.
  struct ViewsCamera {
    cv::Size image_px;
    Eigen::Isometry3d T_world_camera;
    std::optional<Intrinsics> intrinsics;  ///< RgbdFrame::intrinsics
  };
  /// One entry for each size of the views stored in that frame.
  [[nodiscard]] std::vector<ViewsCamera> camerasOfViews(int frame_index) const;
  void beginRefinement();
  /// Objects of unlikely regions alone lose their views, unless a user edited them.
  void dropUnlikely(const std::function<bool(RegionId)>& is_unlikely);
  /// Compares the views of that frame, of images as large as `now`, with the map. A view that shows its
  /// object differently is outdated. It stays valid if most of its content was removed since, unless the
  /// object is still there. `now`: the map rendered from there; `depth_noise_m`: FusionParams.
  void compare(int frame_index, const RenderedView& now, float depth_noise_m);
  /// Better views have replaced these of all(), by index: they are outdated.
  void replace(std::span<const std::size_t> views);
  /// Objects with valid views, by the ids that the views were stored for.
  [[nodiscard]] std::vector<ObjectId> objectsInValidViews() const;
  /// Removes outdated views from the catalogue, and objects that have no others.
  void removeOutdated();

 private:
  [[nodiscard]] std::optional<ObjectView> viewOf(const Candidate& candidate,
                                                 const ObservedFrame& observed) const;
  void noteStored(const ObjectView& view, const Candidate& candidate, const ObservedFrame& observed);
  [[nodiscard]] bool isOutdated(const StoredView& view, const RenderedView& now) const;
  /// The directions from which these objects have views that are not outdated; new views may be stored from
  /// elsewhere.
  void updateDirections(const std::set<ObjectId>& objects);

  CatalogueMirror& catalogue_;
  CatalogueWriter& writer_;
  ObjectTracks& tracks_;
  const UserRequests& requests_;
  const IdentityResolver& identities_;
  DetectionParams params_;
  std::vector<StoredView> views_;
};

}  // namespace scantrove
