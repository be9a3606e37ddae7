#pragma once
#include <functional>
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

/// Gives objects and views of them to the catalogue, and knows which views this scan gave. When a scan is
/// refined, it compares each view with the map, and removes views that do not show their object any more.
class ViewKeeper {
 public:
  /// All outlive the keeper. `views`: that this scan has given so far.
  ViewKeeper(CatalogueMirror& catalogue, CatalogueWriter& writer, ObjectTracks& tracks,
             const UserRequests& requests, const IdentityResolver& identities,
             std::vector<StoredView> views = {});
  [[nodiscard]] const std::vector<StoredView>& all() const { return views_; }
  void setParams(const DetectionParams& params) { params_ = params; }

  /// Adds the candidate as a new object, by its first view. None: the colour image does not show it, or the
  /// catalogue has no room now.
  [[nodiscard]] ObjectId addObject(const Candidate& candidate, const ObservedFrame& observed);
  /// Adds a view of the object if no view shows it from about there.
  void addView(ObjectId object, const Candidate& candidate, const ObservedFrame& observed);

  /// As far as is known, the object is about as large as this candidate.
  [[nodiscard]] bool matchesSize(const ObjectRecord& known, const Candidate& candidate,
                                 const ObservedFrame& observed) const;
  /// The object as a whole has another size, and no view shows it about as large, from wherever.
  [[nodiscard]] bool contradictsSize(const ObjectRecord& known, const Candidate& candidate) const;
  /// A view of it is valid, or the refinement leaves the object as it is.
  [[nodiscard]] bool hasView(ObjectId object) const;

  // Refinement.

  /// RgbdFrame::index of the frames of which views were stored, rising.
  [[nodiscard]] std::vector<int> framesOfViews() const;
  /// Where that frame was taken, and the size of the image that some views of it are of.
  struct ViewsCamera {
    cv::Size image_px;
    Eigen::Isometry3d T_world_camera;
  };
  /// Of each size in which views of that frame were stored.
  [[nodiscard]] std::vector<ViewsCamera> camerasOfViews(int frame_index) const;
  void beginRefinement();
  /// Objects of unlikely regions alone lose their views, unless a user edited them.
  void dropUnlikely(const std::function<bool(RegionId)>& is_unlikely);
  /// Compares views of that frame, of images as large as `now`, with the map. A view that shows its object
  /// otherwise is outdated. If most of what it shows was removed since, it stays valid, unless the object is
  /// still there. `now`: what the map shows from there; `depth_noise_m`: FusionParams.
  void compare(int frame_index, const RenderedView& now, float depth_noise_m);
  /// Objects with valid views, as the views were stored for them.
  [[nodiscard]] std::vector<ObjectId> objectsInValidViews() const;
  /// Outdated views leave the catalogue, and with them the objects that have no other.
  void removeOutdated();

 private:
  [[nodiscard]] std::optional<ObjectView> viewOf(const Candidate& candidate,
                                                 const ObservedFrame& observed) const;
  void noteStored(const ObjectView& view, const Candidate& candidate, const ObservedFrame& observed);
  [[nodiscard]] bool isOutdated(const StoredView& view, const RenderedView& now) const;

  CatalogueMirror& catalogue_;
  CatalogueWriter& writer_;
  ObjectTracks& tracks_;
  const UserRequests& requests_;
  const IdentityResolver& identities_;
  DetectionParams params_;
  std::vector<StoredView> views_;
};

}  // namespace scantrove
