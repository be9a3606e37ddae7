#include "core/collection/view_keeper.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <set>
#include <utility>

#include "core/capture/usable_depth.h"
#include "core/collection/candidate_crop.h"
#include "core/image/sharpness.h"

namespace scantrove {
namespace {

/// Minimum overlap of mask and region, as a fraction of their union; below it the region has changed since.
constexpr float kMinFit = 0.7F;
/// The same for a complete set of several regions, whose views may show only one of them.
constexpr float kMinFitOfSet = 0.6F;

/// A candidate is as large as an object if the smaller size is this fraction of the larger, from one
/// direction. From elsewhere another face comes into sight.
constexpr float kAsLargeFromThere = 0.85F, kAsLargeFromElsewhere = 0.7F;
/// Angle from which on a direction counts as elsewhere.
constexpr float kElsewhere_deg = 40;

/// The frame's depth at the pixels of the candidate's mask; `image_px`: size of the candidate's image.
cv::Mat depthAt(const RgbdFrame& frame, const Candidate& candidate, const cv::Size& image_px) {
  cv::Mat depth, z_m;
  cv::resize(usableDepth(frame), depth, image_px, 0, 0, cv::INTER_NEAREST);
  depth(candidate.box_px).convertTo(z_m, CV_32F, static_cast<double>(frame.meters_per_unit));
  z_m.setTo(0, candidate.mask == 0);
  return z_m;
}

/// The regions that the map shows under a view's mask.
class MaskOverlap {
 public:
  struct Pixels {
    float all = 0, masked = 0;
    void operator+=(const Pixels& other) {
      all += other.all;
      masked += other.masked;
    }
  };

  MaskOverlap(const StoredView& view, const RenderedView& now) {
    std::size_t i = 0;
    for (int v = 0; v < now.K.height; ++v) {
      for (int u = 0; u < now.K.width; ++u) {
        const cv::Point pixel(u, v);
        const bool is_masked =
            view.box_px.contains(pixel) && view.mask.at<unsigned char>(pixel - view.box_px.tl()) != 0;
        const Pixels here{1, is_masked ? 1.0F : 0.0F};
        mask_ += here.masked;
        if (const RegionId region = now.regions[i++]) regions_[region] += here;
      }
    }
  }

  [[nodiscard]] const std::map<RegionId, Pixels>& regions() const { return regions_; }
  [[nodiscard]] Pixels of(const RegionSet& regions) const {
    Pixels together;
    for (const RegionId region : regions) {
      if (const auto found = regions_.find(region); found != regions_.end()) together += found->second;
    }
    return together;
  }
  /// Intersection over union of mask and regions.
  [[nodiscard]] float fit(const Pixels& pixels) const {
    return pixels.masked / std::max(mask_ + pixels.all - pixels.masked, 1.0F);
  }

 private:
  std::map<RegionId, Pixels> regions_;
  float mask_ = 0;
};

/// Most of the surface under the view's mask is gone or hidden by something else.
bool wasRemoved(const StoredView& view, const DepthView& surface, float depth_noise_m) {
  int there = 0, gone = 0;
  for (int v = 0; v < view.z_m.rows; ++v) {
    for (int u = 0; u < view.z_m.cols; ++u) {
      const float then = view.z_m.at<float>(v, u);
      const float now = surface.z_m.at<float>(view.box_px.tl() + cv::Point(u, v));
      if (!(then > 0) || !(now > 0)) continue;
      const bool is_there =
          now <= then + kBehind.at(then, depth_noise_m) && now >= then - kBefore.at(then, depth_noise_m);
      ++(is_there ? there : gone);
    }
  }
  return gone > there;
}

}  // namespace

ViewKeeper::ViewKeeper(CatalogueMirror& catalogue, CatalogueWriter& writer, ObjectTracks& tracks,
                       const UserRequests& requests, const IdentityResolver& identities,
                       std::vector<StoredView> views)
    : catalogue_(catalogue),
      writer_(writer),
      tracks_(tracks),
      requests_(requests),
      identities_(identities),
      views_(std::move(views)) {}

ObjectId ViewKeeper::addObject(const Candidate& candidate, const ObservedFrame& observed) {
  std::optional<ObjectView> view = viewOf(candidate, observed);
  if (!view) return {};
  view->object = catalogue_.nextKey();
  if (!writer_.addObject(*view)) return {};
  catalogue_.add(*view);
  noteStored(*view, candidate, observed);
  return view->object;
}

void ViewKeeper::addView(ObjectId object, const Candidate& candidate, const ObservedFrame& observed) {
  const ObjectRecord* record = catalogue_.currentRecord(object);
  if (record == nullptr || record->views >= params_.max_views || !observed.hasColor()) return;
  const Eigen::Vector3f direction = observed.directionOf(candidate);
  const bool is_new = std::ranges::all_of(tracks_.all(), [&](const auto& track) {
    return catalogue_.mergeRootOf(track.first) != record->id ||
           track.second.views.isNew(direction, params_.new_view_angle_deg);
  });
  if (is_new) static_cast<void>(storeView(object, candidate, observed));
}

bool ViewKeeper::storeView(ObjectId object, const Candidate& candidate, const ObservedFrame& observed) {
  if (!writer_.hasRoomForView(object)) return false;
  std::optional<ObjectView> view = viewOf(candidate, observed);
  if (!view) return false;
  view->object = object;
  catalogue_.addView(*view);
  noteStored(*view, candidate, observed);
  writer_.addView(std::move(*view));
  tracks_.viewsOf(object).keep(observed.directionOf(candidate));
  return true;
}

ViewQuality ViewKeeper::qualityOf(const Candidate& candidate, const ObservedFrame& observed) {
  const cv::Mat& color = observed.frame.color;
  const double scale =
      static_cast<double>(color.total()) / static_cast<double>(observed.in_color.places.total());
  const cv::Rect2f box = boxInColor(observed.in_color, candidate);
  const auto width = static_cast<float>(color.cols), height = static_cast<float>(color.rows);
  const cv::Rect crop = cv::Rect(cv::Point(cvFloor(box.x * width), cvFloor(box.y * height)),
                                 cv::Point(cvCeil(box.br().x * width), cvCeil(box.br().y * height))) &
                        cv::Rect({}, color.size());
  return {static_cast<float>(scale * cv::countNonZero(candidate.mask)),
          crop.empty() ? 0 : sharpnessOf(color(crop)), candidate.outline, candidate.hidden};
}

std::optional<ObjectView> ViewKeeper::viewOf(const Candidate& candidate,
                                             const ObservedFrame& observed) const {
  if (!observed.hasColor()) return std::nullopt;
  std::optional<ObjectView> view = observed.cropView(candidate);
  if (view) view->descriptor = catalogue_.detector().describe(view->color, view->mask);
  return view;
}

void ViewKeeper::noteStored(const ObjectView& view, const Candidate& candidate,
                            const ObservedFrame& observed) {
  const cv::Size image_px = observed.in_color.places.size();
  views_.push_back({view.object, view.frame_index, view.T_world_camera, observed.frame.intrinsics, image_px,
                    candidate.box_px, candidate.mask.clone(), depthAt(observed.frame, candidate, image_px),
                    view.direction, candidate.size_m.norm(), qualityOf(candidate, observed)});
}

bool ViewKeeper::matchesSize(const ObjectRecord& known, const Candidate& candidate,
                             const ObservedFrame& observed) const {
  if (!tracks_.isObserved(known.id)) return true;
  const Eigen::Vector3f direction = observed.directionOf(candidate);
  // Compares with the valid view from the nearest direction.
  float known_m = known.size_m.norm(), cosine = -1;
  bool has_view = false, has_outdated = false;
  for (const StoredView& view : views_) {
    if (catalogue_.mergeRootOf(view.object) != known.id) continue;
    if (view.is_outdated) {
      has_outdated = true;
    } else if (!has_view || view.direction.dot(direction) > cosine) {
      has_view = true;
      cosine = view.direction.dot(direction);
      known_m = view.diagonal_m;
    }
  }
  if ((!has_view && has_outdated) || known_m == 0) return true;
  constexpr float kRadians = std::numbers::pi_v<float> / 180;
  // A larger set may contain other things than the object.
  const bool is_set = candidate.regions.size() > 1;
  const float turned = std::acos(std::clamp(cosine, -1.0F, 1.0F)) / (kElsewhere_deg * kRadians);
  const float elsewhere = is_set ? 0 : std::min(turned, 1.0F);
  const float as_large = std::lerp(kAsLargeFromThere, kAsLargeFromElsewhere, elsewhere);
  const float size_m = candidate.size_m.norm();
  return std::min(size_m, known_m) >= as_large * std::max(size_m, known_m);
}

bool ViewKeeper::contradictsSize(const ObjectRecord& known, const Candidate& candidate) const {
  const float size_m = candidate.size_m.norm();
  const auto isAsLarge = [&](float known_m) {
    return std::min(size_m, known_m) >= kAsLargeFromElsewhere * std::max(size_m, known_m);
  };
  return !isAsLarge(known.size_m.norm()) && std::ranges::none_of(views_, [&](const StoredView& view) {
    return catalogue_.mergeRootOf(view.object) == known.id && isAsLarge(view.diagonal_m);
  });
}

bool ViewKeeper::hasView(ObjectId object) const {
  if (!object) return false;
  if (requests_.isFixed(object)) return true;
  const ObjectId root = catalogue_.mergeRootOf(object);
  return root && std::ranges::any_of(views_, [&](const StoredView& view) {
           return view.isValid() && catalogue_.mergeRootOf(view.object) == root;
         });
}

std::vector<int> ViewKeeper::framesOfViews() const {
  std::set<int> frames;
  for (const StoredView& view : views_) frames.insert(view.frame_index);
  return {frames.begin(), frames.end()};
}

std::vector<ViewKeeper::ViewsCamera> ViewKeeper::camerasOfViews(int frame_index) const {
  std::vector<ViewsCamera> cameras;
  for (const StoredView& view : views_) {
    if (view.frame_index == frame_index &&
        std::ranges::find(cameras, view.image_px, &ViewsCamera::image_px) == cameras.end())
      cameras.push_back({view.image_px, view.T_world_camera, view.intrinsics});
  }
  return cameras;
}

void ViewKeeper::beginRefinement() {
  for (StoredView& view : views_) view.is_outdated = view.is_of_removed = false;
}

void ViewKeeper::dropUnlikely(const std::function<bool(RegionId)>& is_unlikely) {
  for (StoredView& view : views_) {
    const std::vector<RegionId> regions = tracks_.regionsOf(view.object);
    view.is_outdated =
        !requests_.isFixed(view.object) && !regions.empty() && std::ranges::all_of(regions, is_unlikely);
  }
}

void ViewKeeper::compare(int frame_index, const RenderedView& now, float depth_noise_m) {
  const DepthView surface = now.depth();
  std::set<ObjectId> changed;
  for (StoredView& view : views_) {
    if (view.frame_index != frame_index || view.image_px != cv::Size(now.K.width, now.K.height)) continue;
    if (!isOutdated(view, now)) continue;
    const bool is_replaced = identities_.replacementOf(view.object) != view.object;
    if (!is_replaced && wasRemoved(view, surface, depth_noise_m)) {
      view.is_of_removed = true;
      continue;
    }
    view.is_outdated = true;
    changed.insert(view.object);
  }
  updateDirections(changed);
}

void ViewKeeper::replace(std::span<const std::size_t> views) {
  std::set<ObjectId> changed;
  for (const std::size_t i : views) {
    views_[i].is_outdated = true;
    changed.insert(views_[i].object);
  }
  updateDirections(changed);
}

void ViewKeeper::updateDirections(const std::set<ObjectId>& objects) {
  for (const ObjectId object : objects) tracks_.viewsOf(object) = {};
  for (const StoredView& view : views_) {
    if (objects.contains(view.object) && !view.is_outdated) tracks_.viewsOf(view.object).keep(view.direction);
  }
}

bool ViewKeeper::isOutdated(const StoredView& view, const RenderedView& now) const {
  if (requests_.isEdited(view.object)) return false;
  const MaskOverlap overlap(view, now);
  // The largest region of the object, or all of them together; the others are parts.
  MaskOverlap::Pixels together, largest;
  for (const auto& [region, pixels] : overlap.regions()) {
    if (!identities_.haveOneReplacement(tracks_.objectOf(region), view.object)) continue;
    if (pixels.all > largest.all) largest = pixels;
    together += pixels;
  }
  if (std::max(overlap.fit(largest), overlap.fit(together)) < kMinFit) return true;
  bool is_complete_set = false, fits_set = false;
  for (const auto& [set, best_frame] : identities_.complete()) {
    if (!identities_.haveOneReplacement(tracks_.objectOf(set), view.object)) continue;
    is_complete_set = true;
    fits_set = fits_set || overlap.fit(overlap.of(set)) >= kMinFitOfSet;
  }
  return is_complete_set && !fits_set;
}

std::vector<ObjectId> ViewKeeper::objectsInValidViews() const {
  std::vector<ObjectId> objects;
  for (const StoredView& view : views_) {
    if (view.isValid()) objects.push_back(view.object);
  }
  return objects;
}

void ViewKeeper::removeOutdated() {
  std::set<ObjectId> are_there;
  for (const ObjectId object : objectsInValidViews()) {
    if (!tracks_.hasMoved(object)) are_there.insert(catalogue_.mergeRootOf(object));
  }
  // Other views still show the object in place, so it was not removed. This view also contains something
  // that was removed.
  for (StoredView& view : views_) {
    view.is_outdated =
        view.is_outdated || (view.is_of_removed && are_there.contains(catalogue_.mergeRootOf(view.object)));
  }
  std::map<ObjectId, std::vector<int>> outdated;
  for (const StoredView& view : views_) {
    if (view.is_outdated) outdated[view.object].push_back(view.frame_index);
  }
  for (auto& [object, frames] : outdated) writer_.discardViews(object, std::move(frames));
  std::erase_if(views_, &StoredView::is_outdated);
}

}  // namespace scantrove
