#include "core/catalogue/detector.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/catalogue/match_distance.h"

namespace scantrove {

Result<Detector> Detector::create(ComputeContext& compute, const std::string& network) {
  Result<ThumbnailMatcher> matcher = ThumbnailMatcher::create(compute);
  if (!matcher) return fail(matcher.error());
  Detector detector(std::move(*matcher));
  if (!network.empty()) SCANTROVE_TRY(moveInto(detector.network_, AppearanceNetwork::load(network)));
  return detector;
}

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
    findNearest(one, asked, left.first(one.views.size()), objects, match);
    left = left.subspan(one.views.size());
    findGuess(one, asked, left.first(one.guessed_views.size()), match);
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

void Detector::findNearest(const Compared& compared, const ViewIndex::Query& query,
                           std::span<const float> shapes, int objects, DetectionMatch& match) const {
  std::map<ObjectId, float> distances;  // by object
  for (std::size_t i = 0; i < compared.views.size(); ++i) {
    const int view = compared.views[i];
    const float distance = matchDistance(difference(query, view, shapes[i]));
    const ObjectId object = index_.mergeRootAt(view);
    const auto [entry, is_first] = distances.try_emplace(object, distance);
    entry->second = std::min(entry->second, distance);
    if (distance >= match.nearest_distance) continue;
    match.nearest_distance = distance;
    match.nearest = object;
  }
  if (!match.nearest) return;
  distances.erase(match.nearest);
  std::vector<float> others;
  for (const auto& [object, distance] : distances) others.push_back(distance);
  match.distance = relativeDistance(match.nearest_distance, std::move(others), objects);
  if (match.distance < params_.max_distance) match.object = match.nearest;
}

void Detector::findGuess(const Compared& compared, const ViewIndex::Query& query,
                         std::span<const float> shapes, DetectionMatch& match) const {
  for (std::size_t i = 0; i < compared.guessed_views.size(); ++i) {
    ViewDifference difference = this->difference(query, compared.guessed_views[i], shapes[i]);
    difference.size = 0;  // perhaps a part of the object
    const float distance = matchDistance(difference);
    if (distance >= match.guess_distance) continue;
    match.guess_distance = distance;
    match.guess = index_.mergeRootAt(compared.guessed_views[i]);
  }
}

}  // namespace scantrove
