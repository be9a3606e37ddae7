#include "core/catalog/detector.h"

#include <optional>
#include <string>

#include "core/catalog/thumbnail.h"
#include "core/catalog/thumbnail_matcher.h"
#include "core/catalog/view_index.h"

namespace scantrove {

class Detector::Machinery {
 public:
  explicit Machinery(ThumbnailMatcher matcher) : matcher_(std::move(matcher)) {
    // Colour tables and device code are made on first use: now, not in the middle of a scan.
    const cv::Mat color(2, 2, CV_8UC3, cv::Scalar(10, 20, 30)), mask(2, 2, CV_8UC1, cv::Scalar(255));
    const Thumbnail thumbnail = makeThumbnail(color, mask).value();
    matcher_.append(thumbnail);
    static_cast<void>(matcher_.distances({thumbnail}, {{0, 0}}));
    matcher_.clear();
  }

  DetectionParams params;

  [[nodiscard]] int viewCount() const { return index_.size(); }

  void add(ObjectId object, const Thumbnail& thumbnail, const Eigen::Vector3f& size_m) {
    matcher_.append(thumbnail);
    index_.append(object, thumbnail, size_m);
  }

  void remove(ObjectId object) {
    while (const std::optional<int> place = index_.find(object)) {
      matcher_.removeByLast(*place);
      index_.removeByLast(*place);
    }
  }

  void clear() {
    matcher_.clear();
    index_.clear();
  }

  std::vector<DetectionMatch> find(const std::vector<DetectionQuery>& queries) {
    std::vector<DetectionMatch> matches(queries.size());
    std::vector<Thumbnail> thumbnails;
    std::vector<std::size_t> query_of_thumbnail;
    std::vector<ThumbnailMatcher::Pair> pairs;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const std::optional<Thumbnail> thumbnail = makeThumbnail(queries[i].color, queries[i].mask);
      if (!thumbnail) continue;
      const int query = static_cast<int>(thumbnails.size());
      const ViewIndex::Limits limits{params.size_tolerance, params.max_distance, params.shortlist};
      for (const int view : index_.shortlist({*thumbnail, queries[i].size_m}, limits))
        pairs.push_back({query, view});
      thumbnails.push_back(*thumbnail);
      query_of_thumbnail.push_back(i);
    }
    const std::vector<float> warped = matcher_.distances(thumbnails, pairs);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const ThumbnailMatcher::Pair& pair = pairs[i];
      const auto query = static_cast<std::size_t>(pair.query);
      const float distance = warped[i] + index_.colorTerm(thumbnails[query], pair.view);
      DetectionMatch& match = matches[query_of_thumbnail[query]];
      if (distance >= match.distance) continue;
      match.distance = distance;
      match.object = distance < params.max_distance ? index_.objectAt(pair.view) : ObjectId{};
    }
    return matches;
  }

 private:
  ThumbnailMatcher matcher_;
  ViewIndex index_;
};

Result<std::unique_ptr<Detector>> Detector::create(ComputeContext& compute) {
  Result<ThumbnailMatcher> matcher = ThumbnailMatcher::create(compute);
  if (!matcher) return fail(matcher.error());
  std::unique_ptr<Detector> detector(new Detector);
  try {
    detector->machinery_ = std::make_unique<Machinery>(std::move(*matcher));
  } catch (const cl::Error& error) {
    return fail("The OpenCL device " + compute.deviceName() + " could not run the detector (" + error.what() +
                    ", code " + std::to_string(error.err()) + ").",
                "Choose another with --device; 'scantrove devices' lists them.");
  }
  return detector;
}

Detector::Detector() = default;
Detector::~Detector() = default;

void Detector::setParams(const DetectionParams& params) { machinery_->params = params; }

void Detector::add(ObjectId object, const cv::Mat& color, const cv::Mat& mask,
                   const Eigen::Vector3f& size_m) {
  if (const std::optional<Thumbnail> thumbnail = makeThumbnail(color, mask)) {
    machinery_->add(object, *thumbnail, size_m);
  }
}

void Detector::add(ObjectId object, const Thumbnail& thumbnail, const Eigen::Vector3f& size_m) {
  machinery_->add(object, thumbnail, size_m);
}

void Detector::remove(ObjectId object) { machinery_->remove(object); }
void Detector::clear() { machinery_->clear(); }
int Detector::viewCount() const { return machinery_->viewCount(); }

std::vector<DetectionMatch> Detector::find(const std::vector<DetectionQuery>& queries) {
  return machinery_->find(queries);
}

}  // namespace scantrove
