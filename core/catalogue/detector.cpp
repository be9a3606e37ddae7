#include "core/catalogue/detector.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/catalogue/appearance_network.h"
#include "core/catalogue/match_distance.h"

namespace scantrove {
Result<Detector> Detector::create(ComputeContext& compute, const std::string& network) {
  Result<ThumbnailMatcher> matcher = ThumbnailMatcher::create(compute);
  if (!matcher) return fail(matcher.error());
  Detector detector(std::move(*matcher));
  if (!network.empty()) {
    Result<AppearanceNetwork> loaded = AppearanceNetwork::load(network);
    if (!loaded) return fail(loaded.error());
    detector.network_ = std::make_unique<AppearanceNetwork>(std::move(*loaded));
  }
  return detector;
}

Detector::Detector(ThumbnailMatcher matcher) : matcher_(std::move(matcher)) {}
Detector::~Detector() = default;
Detector::Detector(Detector&& other) noexcept = default;
Detector& Detector::operator=(Detector&& other) noexcept = default;

void Detector::warmUp() {
  const cv::Mat color(2, 2, CV_8UC3, cv::Scalar(10, 20, 30)), mask(2, 2, CV_8UC1, cv::Scalar(255));
  const Thumbnail thumbnail = makeThumbnail(color, mask).value();
  const bool is_empty = matcher_.size() == 0;
  if (is_empty) matcher_.append(thumbnail);
  static_cast<void>(matcher_.distances({thumbnail}, {{0, 0}}));
  if (is_empty) matcher_.clear();
}

std::optional<ViewDescriptor> Detector::describe(const cv::Mat& color, const cv::Mat& mask) {
  std::optional<ViewDescriptor> descriptor = describeView(color, mask);
  if (descriptor && network_) descriptor->network = network_->describe(color, mask);
  return descriptor;
}

void Detector::add(const StoredDescriptor& view) {
  matcher_.append(view.descriptor.thumbnail);
  ViewDescriptor comparable = view.descriptor;
  if (!network_ || (comparable.network && comparable.network->network != network_->hash()))
    comparable.network.reset();
  index_.append(view.first_object, comparable, view.size_m);
}

std::vector<DetectionMatch> Detector::find(const std::vector<DetectionQuery>& queries) {
  std::vector<DetectionMatch> matches(queries.size());
  std::vector<Thumbnail> thumbnails;
  std::vector<Compared> compared;
  std::vector<ThumbnailMatcher::Pair> pairs;
  const ViewIndex::Limits limits{params_.size_tolerance, params_.max_distance};
  for (std::size_t i = 0; i < queries.size(); ++i) {
    std::optional<ViewDescriptor> descriptor = describe(queries[i].color, queries[i].mask);
    if (!descriptor) continue;
    const int query = static_cast<int>(thumbnails.size());
    const ViewIndex::Query asked{*descriptor, queries[i].size_m};
    Compared one;
    one.query = i;
    one.views = index_.shortlist(asked, params_.shortlist);
    one.guessed_views = index_.viewsOf(queries[i].guesses, asked, limits);
    for (const int view : one.views) pairs.push_back({query, view});
    for (const int view : one.guessed_views) pairs.push_back({query, view});
    thumbnails.push_back(descriptor->thumbnail);
    one.descriptor = std::move(*descriptor);
    compared.push_back(std::move(one));
  }
  const std::vector<float> shapes = matcher_.distances(thumbnails, pairs);
  const int objects = index_.countObjects(kObjectsToCompare);
  std::span<const float> left = shapes;
  for (const Compared& one : compared) {
    const ViewIndex::Query asked{one.descriptor, queries[one.query].size_m};
    DetectionMatch& match = matches[one.query];
    const std::span<const float> of_views = left.first(one.views.size());
    findNearest(distances(asked, one.views, of_views), objects, match);
    acceptNearest(asked, one.views, of_views, match);
    left = left.subspan(one.views.size());
    findGuess(asked, one.guessed_views, left.first(one.guessed_views.size()), match);
    left = left.subspan(one.guessed_views.size());
  }
  return matches;
}

ViewDifference Detector::difference(const ViewIndex::Query& query, int view, float shape) const {
  ViewDifference difference = index_.difference(query, view);
  difference.shape = shape;
  if (network_) difference.network = network_->distance(query.descriptor.network, index_.networkAt(view));
  return difference;
}

std::map<ObjectId, float> Detector::distances(const ViewIndex::Query& query, std::span<const int> views,
                                              std::span<const float> shapes) const {
  std::map<ObjectId, std::vector<float>> of_views;
  for (std::size_t i = 0; i < views.size(); ++i)
    of_views[index_.mergeRootAt(views[i])].push_back(matchDistance(difference(query, views[i], shapes[i])));
  std::map<ObjectId, float> of_objects;
  for (auto& [object, all] : of_views) of_objects.emplace(object, objectDistance(std::move(all)));
  return of_objects;
}

void Detector::findNearest(std::map<ObjectId, float> of_objects, int objects, DetectionMatch& match) {
  const auto nearest =
      std::ranges::min_element(of_objects, {}, [](const auto& entry) { return entry.second; });
  if (nearest == of_objects.end() || nearest->second >= match.nearest_distance) return;
  match.nearest = nearest->first;
  match.nearest_distance = nearest->second;
  of_objects.erase(nearest);
  std::vector<float> others;
  for (const auto& [object, distance] : of_objects) others.push_back(distance);
  match.distance = relativeDistance(match.nearest_distance, std::move(others), objects);
}

void Detector::acceptNearest(const ViewIndex::Query& query, std::span<const int> views,
                             std::span<const float> shapes, DetectionMatch& match) const {
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!index_.hasSize(query, views[i], params_.size_tolerance)) continue;
    match.thumbnail_distance =
        std::min(match.thumbnail_distance, thumbnailDistance(difference(query, views[i], shapes[i])));
    if (match.distance < params_.max_distance && index_.mergeRootAt(views[i]) == match.nearest)
      match.object = match.nearest;
  }
}

void Detector::findGuess(const ViewIndex::Query& query, std::span<const int> views,
                         std::span<const float> shapes, DetectionMatch& match) const {
  for (std::size_t i = 0; i < views.size(); ++i) {
    const float distance = thumbnailDistance(difference(query, views[i], shapes[i]));
    if (distance >= match.guess_distance) continue;
    match.guess_distance = distance;
    match.guess = index_.mergeRootAt(views[i]);
  }
}

}  // namespace scantrove
