// What ObjectCollector does when a scan has ended and everything is looked at again.
#include <algorithm>
#include <map>
#include <opencv2/imgproc.hpp>
#include <set>

#include "core/scan/candidate_crop.h"
#include "core/scan/clarity.h"
#include "core/scan/object_collector.h"

namespace scantrove {
namespace {

/// Of mask and region together both must be this part, or the view is of what the region was once.
constexpr float kMinFit = 0.7F;
/// The same of a whole of several regions, whose views may be of one of them.
constexpr float kMinFitOfWhole = 0.6F;
/// So many looks at what the scan took for new are held against what earlier scans know.
constexpr int kLooksBack = 4;

/// The frame's readings at the pixels of a mask, which is at `box_px` of an image of `image_px`.
cv::Mat readingsAt(const RgbdFrame& frame, const cv::Rect& box_px, const cv::Mat& mask,
                   const cv::Size& image_px) {
  cv::Mat depth, z_m;
  cv::resize(frame.depth, depth, image_px, 0, 0, cv::INTER_NEAREST);
  depth(box_px).convertTo(z_m, CV_32F, static_cast<double>(frame.meters_per_unit));
  z_m.setTo(0, mask == 0);
  return z_m;
}

/// What regions a map shows where a view has its mask.
class MaskOverlap {
 public:
  struct Pixels {
    float all = 0, masked = 0;
    void operator+=(const Pixels& other) {
      all += other.all;
      masked += other.masked;
    }
  };

  MaskOverlap(const KeptView& view, const RenderedView& now) {
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
  /// Pixels of both mask and regions, by those of either.
  [[nodiscard]] float fit(const Pixels& pixels) const {
    return pixels.masked / std::max(mask_ + pixels.all - pixels.masked, 1.0F);
  }

 private:
  std::map<RegionId, Pixels> regions_;
  float mask_ = 0;
};

/// Where most of the view's thing was there is no surface any more, or something stands before it.
bool wasTakenAway(const KeptView& view, const DepthView& surface, float depth_noise_m) {
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

void ObjectCollector::noteKept(const ObjectView& view, const Candidate& candidate, const RgbdFrame& frame,
                               const cv::Size& image_px) {
  kept_views_.push_back({view.object, view.frame_index, view.T_world_camera, image_px, candidate.box_px,
                         candidate.mask.clone(),
                         readingsAt(frame, candidate.box_px, candidate.mask, image_px), view.direction,
                         candidate.size_m.norm()});
}

void ObjectCollector::beginLookingAgain() {
  mergeJoined(Which::all);
  is_looking_again_ = true;
  // Of a refinement that begins anew because a person has changed something since.
  are_last_looks_ = false;
  wholes_.clear();
  looks_back_.clear();
  for (KeptView& view : kept_views_) view.is_outdated = view.shows_removed_object = false;
}

bool ObjectCollector::isByPerson(ObjectId object) const {
  const ObjectRecord* root = recordOf(catalogue_.mergeRootOf(object));
  return root == nullptr || isSettled(*root) || by_person_.contains(object) ||
         catalogue_.isRegrouped(root->id);
}

bool ObjectCollector::staysAsItIs(ObjectId object) const {
  return isByPerson(object) || !CatalogueMirror::isOfThisScan(catalogue_.mergeRootOf(object));
}

void ObjectCollector::bindComplete(std::span<const CompleteSet> complete) {
  std::set<ObjectId> taken_roots;
  for (const auto& [regions, best_frame] : complete) {
    std::vector<ObjectId> objects;  // that its regions were taken for
    for (const RegionId region : regions) {
      const ObjectId object = met_.objectOf(region);
      if (object && !std::ranges::count(objects, object)) objects.push_back(object);
    }
    // What a person deleted stays so.
    if (!std::ranges::all_of(objects, [this](ObjectId object) { return !!catalogue_.mergeRootOf(object); }))
      continue;
    // What a person spoke of comes first, and stays apart.
    std::stable_partition(objects.begin(), objects.end(),
                          [this](ObjectId object) { return staysAsItIs(object); });
    if (objects.size() > 1 && staysAsItIs(objects[1])) continue;
    wholes_.emplace(regions, best_frame);
    for (const ObjectId object : objects) met_.unbind(regions, object);
    // Two wholes are one object only where a person said so.
    std::erase_if(objects, [&](ObjectId object) {
      return !staysAsItIs(object) && taken_roots.contains(catalogue_.mergeRootOf(object));
    });
    if (objects.empty()) continue;
    // What is a whole was not replaced by what is another.
    const bool is_with_successor = std::any_of(objects.begin() + 1, objects.end(), [&](ObjectId object) {
      return successorOf(object) == successorOf(objects.front());
    });
    if (!is_with_successor) successor_.erase(objects.front());
    met_.bind(regions, objects.front());
    taken_roots.insert(catalogue_.mergeRootOf(objects.front()));
  }
}

void ObjectCollector::settleComplete(std::span<const CompleteSet> complete,
                                     const std::function<bool(RegionId)>& is_unlikely) {
  bindComplete(complete);
  for (KeptView& view : kept_views_) {
    const std::vector<RegionId> regions = met_.regionsOf(view.object);
    view.is_outdated =
        !staysAsItIs(view.object) && !regions.empty() && std::ranges::all_of(regions, is_unlikely);
  }
}

std::vector<int> ObjectCollector::framesOfViews() const {
  std::set<int> frames;
  for (const KeptView& view : kept_views_) frames.insert(view.frame_index);
  return {frames.begin(), frames.end()};
}

bool ObjectCollector::mayBeObject(const RegionSet& regions) const {
  return wholes_.contains(regions) || isWanted(regions);
}

std::vector<ObjectCollector::ViewsCamera> ObjectCollector::camerasOfViews(int frame_index) const {
  std::vector<ViewsCamera> cameras;
  for (const KeptView& view : kept_views_) {
    if (view.frame_index == frame_index &&
        std::ranges::find(cameras, view.image_px, &ViewsCamera::image_px) == cameras.end())
      cameras.push_back({view.image_px, view.T_world_camera});
  }
  return cameras;
}

/// What the first looks showed may have been a part of it, or poor, and nothing that is known; and the place
/// may be known only by now.
void ObjectCollector::lookAmongThoseOfBefore(const std::vector<const Candidate*>& chosen, const Look& look) {
  if (look.frame.color.empty()) return;
  std::vector<ObjectId> unmet = catalogue_.ofBefore();
  // What this map has elsewhere, as an earlier scan of it found out, is there, met today or not.
  std::erase_if(unmet, [this](ObjectId object) { return isMet(object) || met_.hasRegions(object); });
  if (unmet.empty()) return;
  const float surely = RecognitionHistory::kSurePart * params_.max_distance;
  struct Asked {
    ObjectId object;
    float enough;  ///< a smaller distance is
  };
  std::vector<DetectionQuery> queries;
  std::vector<Asked> asked;
  for (const Candidate* candidate : chosen) {
    const ObjectId object = met_.objectOf(candidate->regions);
    if (!object || staysAsItIs(object) || !isClear(*candidate, kForView) || looks_back_[object] >= kLooksBack)
      continue;
    const std::optional<ObjectView> view =
        cropView(look.frame, look.T_world_camera, look.in_color, *candidate);
    if (!view) continue;
    ++looks_back_[object];
    queries.push_back({view->color, view->mask, candidate->size_m, unmet});
    asked.push_back({object, surely});
    std::vector<ObjectId> expected = expectedAt(*candidate);
    if (expected.empty()) continue;
    queries.push_back({view->color, view->mask, candidate->size_m, std::move(expected)});
    asked.push_back({object, kExpectedDistance});
  }
  if (queries.empty()) return;
  const std::vector<DetectionMatch> matches = catalogue_.detector().find(queries);
  std::set<ObjectId> found;  // two of a kind are two
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const ObjectId before = matches[i].guess;
    if (before && matches[i].guess_distance < asked[i].enough && found.insert(before).second)
      joined_.push_back({before, asked[i].object, {}, frame_});
  }
}

std::vector<int> ObjectCollector::beginLastLooks() {
  are_last_looks_ = true;
  std::set<int> frames;
  for (const auto& [regions, frame_index] : wholes_) {
    if (!hasView(met_.objectOf(regions))) frames.insert(frame_index);
  }
  return {frames.begin(), frames.end()};
}

bool ObjectCollector::hasView(ObjectId object) const {
  if (!object) return false;
  if (staysAsItIs(object)) return true;
  const ObjectId root = catalogue_.mergeRootOf(object);
  return root && std::ranges::any_of(kept_views_, [&](const KeptView& view) {
           return !view.is_outdated && !view.shows_removed_object &&
                  catalogue_.mergeRootOf(view.object) == root;
         });
}

bool ObjectCollector::isOfAnotherWhole(ObjectId object, const RegionSet& regions) const {
  const ObjectId root = catalogue_.mergeRootOf(object);
  if (!root || staysAsItIs(object)) return false;
  return std::ranges::any_of(wholes_, [&](const auto& whole) {
    return whole.first != regions && catalogue_.mergeRootOf(met_.objectOf(whole.first)) == root;
  });
}

bool ObjectCollector::isLastLook(const Candidate& candidate, const Look& look) const {
  if (!are_last_looks_) return false;
  const auto whole = wholes_.find(candidate.regions);
  return whole != wholes_.end() && whole->second == look.frame.index;
}

void ObjectCollector::judgeViewsOf(int frame_index, const RenderedView& now, float depth_noise_m) {
  const DepthView surface = now.depth();
  std::set<ObjectId> changed;
  for (KeptView& view : kept_views_) {
    if (view.frame_index != frame_index || view.image_px != cv::Size(now.K.width, now.K.height)) continue;
    if (!isOutdated(view, now)) continue;
    const bool is_doubted = successorOf(view.object) != view.object;
    if (!is_doubted && wasTakenAway(view, surface, depth_noise_m)) {
      view.shows_removed_object = true;
      continue;
    }
    view.is_outdated = true;
    changed.insert(view.object);
  }
  // From there the object may be taken anew.
  for (const ObjectId object : changed) met_.met(object).views = {};
  for (const KeptView& view : kept_views_) {
    if (changed.contains(view.object) && !view.is_outdated) met_.met(view.object).views.keep(view.direction);
  }
}

bool ObjectCollector::haveOneSuccessor(ObjectId a, ObjectId b) const {
  const ObjectId root = catalogue_.mergeRootOf(successorOf(a));
  return root && root == catalogue_.mergeRootOf(successorOf(b));
}

bool ObjectCollector::isOutdated(const KeptView& view, const RenderedView& now) const {
  if (isByPerson(view.object)) return false;  // it is as it was then
  const MaskOverlap overlap(view, now);
  // The largest region of the object, or all of them together: the others are parts.
  MaskOverlap::Pixels together, largest;
  for (const auto& [region, pixels] : overlap.regions()) {
    if (!haveOneSuccessor(met_.objectOf(region), view.object)) continue;
    if (pixels.all > largest.all) largest = pixels;
    together += pixels;
  }
  if (std::max(overlap.fit(largest), overlap.fit(together)) < kMinFit) return true;
  bool is_known_whole = false, fits_whole = false;
  for (const auto& [whole, frame_index] : wholes_) {
    if (!haveOneSuccessor(met_.objectOf(whole), view.object)) continue;
    is_known_whole = true;
    fits_whole = fits_whole || overlap.fit(overlap.of(whole)) >= kMinFitOfWhole;
  }
  return is_known_whole && !fits_whole;
}

void ObjectCollector::mergeSuccessors() {
  for (const KeptView& view : kept_views_) {
    if (view.is_outdated || view.shows_removed_object) continue;
    const ObjectId object = catalogue_.mergeRootOf(view.object);
    const ObjectId last = catalogue_.mergeRootOf(successorOf(view.object));
    if (!shouldMerge(last, object)) continue;
    catalogue_.merge(last, object);
    writer_->merge(last, object);
  }
}

void ObjectCollector::endLookingAgain() {
  is_looking_again_ = are_last_looks_ = false;
  wholes_.clear();
  looks_back_.clear();
  mergeSuccessors();
  std::set<ObjectId> are_there;
  for (const KeptView& view : kept_views_) {
    if (!view.is_outdated && !view.shows_removed_object && !hasMoved(view.object))
      are_there.insert(catalogue_.mergeRootOf(view.object));
  }
  // What is there as its other views show it did not leave: something else did, that this one shows with it.
  for (KeptView& view : kept_views_) {
    view.is_outdated = view.is_outdated ||
                       (view.shows_removed_object && are_there.contains(catalogue_.mergeRootOf(view.object)));
  }
  std::map<ObjectId, std::vector<int>> outdated;
  for (const KeptView& view : kept_views_) {
    if (view.is_outdated) outdated[view.object].push_back(view.frame_index);
  }
  for (auto& [object, frames] : outdated) writer_->discardViews(object, std::move(frames));
  std::erase_if(kept_views_, &KeptView::is_outdated);
}

}  // namespace scantrove
