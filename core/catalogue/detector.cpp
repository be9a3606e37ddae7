#include "core/catalogue/detector.h"

#include <optional>
#include <string>

#include "core/catalogue/thumbnail.h"

namespace scantrove {

Result<Detector> Detector::create(ComputeContext& compute) {
  Result<ThumbnailMatcher> matcher = ThumbnailMatcher::create(compute);
  if (!matcher) return fail(matcher.error());
  return Detector(std::move(*matcher));
}

void Detector::warmUp() {
  const cv::Mat color(2, 2, CV_8UC3, cv::Scalar(10, 20, 30)), mask(2, 2, CV_8UC1, cv::Scalar(255));
  const Thumbnail thumbnail = makeThumbnail(color, mask).value();
  const bool is_empty = matcher_.size() == 0;
  if (is_empty) matcher_.append(thumbnail);
  static_cast<void>(matcher_.distances({thumbnail}, {{0, 0}}));
  if (is_empty) matcher_.clear();
}

void Detector::add(const StoredDescriptor& view) {
  matcher_.append(view.thumbnail);
  index_.append(view.first_object, view.thumbnail, view.size_m);
}

std::vector<DetectionMatch> Detector::find(const std::vector<DetectionQuery>& queries) {
  std::vector<DetectionMatch> matches(queries.size());
  std::vector<Thumbnail> thumbnails;
  std::vector<std::size_t> query_of_thumbnail;
  std::vector<ThumbnailMatcher::Pair> pairs;
  std::vector<bool> is_guess;  // by pair
  const ViewIndex::Limits limits{params_.size_tolerance, params_.max_distance, params_.shortlist};
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const std::optional<Thumbnail> thumbnail = makeThumbnail(queries[i].color, queries[i].mask);
    if (!thumbnail) continue;
    const int query = static_cast<int>(thumbnails.size());
    const ViewIndex::Query asked{*thumbnail, queries[i].size_m};
    for (const int view : index_.shortlist(asked, limits)) pairs.push_back({query, view});
    is_guess.resize(pairs.size(), false);
    for (const int view : index_.viewsOf(queries[i].guesses, asked, limits)) pairs.push_back({query, view});
    is_guess.resize(pairs.size(), true);
    thumbnails.push_back(*thumbnail);
    query_of_thumbnail.push_back(i);
  }
  const std::vector<float> warped = matcher_.distances(thumbnails, pairs);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ThumbnailMatcher::Pair& pair = pairs[i];
    const auto query = static_cast<std::size_t>(pair.query);
    const float distance = warped[i] + index_.colorTerm(thumbnails[query], pair.view);
    DetectionMatch& match = matches[query_of_thumbnail[query]];
    if (is_guess[i]) {
      if (distance >= match.guess_distance) continue;
      match.guess_distance = distance;
      match.guess = index_.mergeRootAt(pair.view);
      continue;
    }
    if (distance >= match.distance) continue;
    match.distance = distance;
    match.nearest = index_.mergeRootAt(pair.view);
    match.object = distance < params_.max_distance ? match.nearest : ObjectId{};
  }
  return matches;
}

}  // namespace scantrove
