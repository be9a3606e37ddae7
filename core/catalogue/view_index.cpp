#include "core/catalogue/view_index.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_set>

namespace scantrove {
namespace {

constexpr int kMaxSamples = 256;  // views for fitting the components
constexpr float kGrowthToRefit = 1.5F;
constexpr float kColorUnit = 40;  // CIE units of mean colour per unit of distance

using Coarse = decltype(Thumbnail::coarse);

/// One row of CV_32FC1.
cv::Mat toRow(const Coarse& coarse) { return cv::Mat_<float>(cv::Mat_<std::int8_t>(coarse, true).t()); }

Coarse mirrored(const Coarse& coarse) {
  Coarse result;
  for (std::size_t row = 0; row < coarse.size(); row += Thumbnail::kCoarseSide) {
    const auto begin = coarse.begin() + static_cast<std::ptrdiff_t>(row);
    std::reverse_copy(begin, begin + Thumbnail::kCoarseSide,
                      result.begin() + static_cast<std::ptrdiff_t>(row));
  }
  return result;
}

float energyOf(const Coarse& coarse) {
  const int energy = std::inner_product(coarse.begin(), coarse.end(), coarse.begin(), 0);
  return static_cast<float>(energy);
}

float meanColorDistance(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return (a - b).squaredNorm() / (kColorUnit * kColorUnit);
}

/// A size of zero is unknown and agrees with all.
bool sizesAgree(float a, float b, float tolerance) {
  return !(a > 0 && b > 0) || std::abs(a - b) <= tolerance * std::max(a, b);
}

/// Between half and all of a larger object.
bool isPartOf(float diagonal_m, float whole_m) {
  return diagonal_m < whole_m && diagonal_m >= 0.5F * whole_m;
}

}  // namespace

std::uint32_t ViewIndex::ownerOf(ObjectId first_object) {
  const auto [entry, is_new] =
      owners_.try_emplace(first_object, static_cast<std::uint32_t>(merge_roots_.size()));
  if (is_new) merge_roots_.emplace_back();
  return entry->second;
}

void ViewIndex::setMergeRoot(const MergeRoot& entry) { merge_roots_[ownerOf(entry.object)] = entry.root; }

ObjectId ViewIndex::mergeRootOf(ObjectId object) const {
  const auto found = owners_.find(object);
  return found == owners_.end() ? ObjectId{} : merge_roots_[found->second];
}

int ViewIndex::countObjects(int most) const {
  std::vector<ObjectId> roots;
  for (const View& view : views_) {
    const ObjectId root = merge_roots_[view.owner];
    if (root && std::ranges::find(roots, root) == roots.end()) roots.push_back(root);
    if (std::ssize(roots) >= most) break;
  }
  return static_cast<int>(roots.size());
}

void ViewIndex::append(ObjectId first_object, const ViewDescriptor& descriptor,
                       const Eigen::Vector3f& size_m) {
  const Thumbnail& thumbnail = descriptor.thumbnail;
  views_.push_back({ownerOf(first_object), thumbnail.mean_lab, size_m, energyOf(thumbnail.coarse)});
  colors_.push_back(descriptor.colors);
  networks_.push_back(descriptor.network);
  if (sketches_.size() > 0) return sketches_.append(sketchOf(thumbnail.coarse, descriptor.colors, size_m));
  coarse_.push_back(thumbnail.coarse);
  if (size() >= kManyViews) beginSketches();
}

void ViewIndex::beginSketches() {
  for (std::size_t i = 0; i < views_.size(); ++i)
    sketches_.append(sketchOf(coarse_[i], colors_[i], views_[i].size_m));
  coarse_ = {};
  coordinates_ = {};
  components_ = {};
}

void ViewIndex::updateComponents() {
  if (size() < kFewViews) return;
  if (static_cast<float>(size()) >= kGrowthToRefit * static_cast<float>(views_at_fit_)) {
    const int samples = std::min(size(), kMaxSamples);
    cv::Mat rows;
    for (int i = 0; i < samples; ++i) {
      const auto place = static_cast<std::size_t>(static_cast<std::int64_t>(i) * size() / samples);
      rows.push_back(toRow(coarse_[place]));
    }
    components_ = cv::PCA(rows, cv::noArray(), cv::PCA::DATA_AS_ROW, Coordinates::channels);
    views_at_fit_ = size();
    coordinates_.clear();
  }
  while (coordinates_.size() < coarse_.size()) coordinates_.push_back(project(coarse_[coordinates_.size()]));
}

ViewIndex::Coordinates ViewIndex::project(const Coarse& coarse) const {
  Coordinates coordinates;
  components_.project(toRow(coarse), cv::Mat(1, Coordinates::channels, CV_32F, coordinates.val));
  return coordinates;
}

std::vector<ViewIndex::Ranked> ViewIndex::rank(const Query& query) const {
  const Thumbnail& thumbnail = query.descriptor.thumbnail;
  const float energy = energyOf(thumbnail.coarse);
  Coordinates straight, flipped;
  const bool has_components = !components_.eigenvectors.empty();
  if (has_components) {
    straight = project(thumbnail.coarse);
    flipped = project(mirrored(thumbnail.coarse));
  }
  std::vector<Ranked> ranked;
  ranked.reserve(views_.size());
  for (int place = 0; place < size(); ++place) {
    const View& view = views_[static_cast<std::size_t>(place)];
    if (!merge_roots_[view.owner]) continue;
    ViewDifference probable{0, meanColorDistance(thumbnail.mean_lab, view.mean_lab), {}, 0, {}};
    probable.size = sizeDifference(query.size_m, view.size_m);
    if (has_components) {
      const Coordinates& coordinates = coordinates_[static_cast<std::size_t>(place)];
      const double ssd = std::min(cv::norm(straight, coordinates, cv::NORM_L2SQR),
                                  cv::norm(flipped, coordinates, cv::NORM_L2SQR));
      probable.shape = 2 * static_cast<float>(ssd) / std::max(energy + view.energy, 1.0F);
    }
    ranked.push_back({matchDistance(probable), place});
  }
  return ranked;
}

bool ViewIndex::areOfTooFew(const std::vector<ViewSketches::Near>& near) const {
  std::unordered_set<ObjectId> objects;
  for (const ViewSketches::Near& one : near) objects.insert(mergeRootAt(one.place));
  return std::ssize(objects) < countObjects(kObjectsToCompare);
}

std::vector<ViewIndex::Ranked> ViewIndex::rankBySketch(const Query& query) const {
  const Thumbnail& thumbnail = query.descriptor.thumbnail;
  const ViewSketch sketch = sketchOf(thumbnail.coarse, query.descriptor.colors, query.size_m);
  const auto hasOwner = [this](int place) { return static_cast<bool>(mergeRootAt(place)); };
  std::vector<ViewSketches::Near> near = sketches_.nearest(sketch, kNearBySketch, hasOwner);
  // An object with very many views can hide all others.
  for (std::size_t most = 8 * kNearBySketch; near.size() < views_.size() && areOfTooFew(near); most *= 8) {
    const std::size_t before = near.size();
    near = sketches_.nearest(sketch, most, hasOwner);
    if (near.size() == before) break;  // all that have an owner
  }
  std::vector<Ranked> ranked;
  ranked.reserve(near.size());
  for (const ViewSketches::Near& one : near) {
    ViewDifference probable = difference(query, one.place);
    probable.shape = one.shape;
    ranked.push_back({matchDistance(probable), one.place});
  }
  return ranked;
}

std::vector<int> ViewIndex::shortlist(const Query& query, int most) {
  const bool has_sketches = sketches_.size() > 0;
  if (!has_sketches) updateComponents();
  std::vector<Ranked> ranked = has_sketches ? rankBySketch(query) : rank(query);
  const bool prune = has_sketches || !components_.eigenvectors.empty();
  // A heap, because only a few of many views are taken; the nearest, then the first, is on top.
  const auto isAfter = [](const Ranked& a, const Ranked& b) {
    return a.distance > b.distance || (a.distance == b.distance && a.place > b.place);
  };
  std::ranges::make_heap(ranked, isAfter);
  std::vector<int> places;
  std::unordered_map<ObjectId, int> views_of;
  while (!ranked.empty() && (!prune || std::ssize(places) < std::max(most, 1))) {
    std::ranges::pop_heap(ranked, isAfter);
    const int place = ranked.back().place;
    ranked.pop_back();
    if (!prune || ++views_of[mergeRootAt(place)] <= kViewsOfAnObject) places.push_back(place);
  }
  return places;
}

std::vector<int> ViewIndex::viewsOf(std::span<const ObjectId> roots, const Query& query,
                                    const Limits& limits) const {
  std::vector<int> places;
  if (roots.empty()) return places;
  const std::unordered_set<ObjectId> asked(roots.begin(), roots.end());
  const float diagonal_m = query.size_m.norm();
  for (int place = 0; place < size(); ++place) {
    const View& view = views_[static_cast<std::size_t>(place)];
    const float color = meanColorDistance(query.descriptor.thumbnail.mean_lab, view.mean_lab);
    if (!(color < limits.max_distance)) continue;
    const bool fits =
        hasSize(query, place, limits.size_tolerance) || isPartOf(diagonal_m, view.size_m.norm());
    if (fits && asked.contains(merge_roots_[view.owner])) places.push_back(place);
  }
  if (sketches_.size() == 0 || places.size() <= kMostOfRoots) return places;
  const ViewSketch sketch =
      sketchOf(query.descriptor.thumbnail.coarse, query.descriptor.colors, query.size_m);
  std::vector<Ranked> ranked;
  for (const ViewSketches::Near& one : sketches_.at(sketch, places)) {
    const View& view = views_[static_cast<std::size_t>(one.place)];
    const float color = meanColorDistance(query.descriptor.thumbnail.mean_lab, view.mean_lab);
    ranked.push_back({one.shape + color, one.place});
  }
  std::ranges::nth_element(ranked, ranked.begin() + kMostOfRoots, {}, &Ranked::distance);
  places.clear();
  for (std::size_t i = 0; i < kMostOfRoots; ++i) places.push_back(ranked[i].place);
  std::ranges::sort(places);
  return places;
}

bool ViewIndex::hasSize(const Query& query, int place, float tolerance) const {
  return sizesAgree(query.size_m.norm(), views_[static_cast<std::size_t>(place)].size_m.norm(), tolerance);
}

ViewDifference ViewIndex::difference(const Query& query, int place) const {
  const View& view = views_[static_cast<std::size_t>(place)];
  const std::optional<ViewColors>& colors = colors_[static_cast<std::size_t>(place)];
  ViewDifference difference;
  difference.mean_color = meanColorDistance(query.descriptor.thumbnail.mean_lab, view.mean_lab);
  if (colors && query.descriptor.colors) difference.colors = colorDistance(*query.descriptor.colors, *colors);
  difference.size = sizeDifference(query.size_m, view.size_m);
  return difference;
}

}  // namespace scantrove
