#include "core/evaluation/nyu2.h"

#include <algorithm>
#include <cstdint>
#include <iomanip>
#include <locale>
#include <opencv2/core.hpp>
#include <set>
#include <sstream>
#include <utility>

#include "core/base/check.h"
#include "core/evaluation/boundary_error.h"
#include "core/evaluation/label_grid.h"

namespace scantrove {
namespace {

// Table 4.1 of the thesis.
constexpr double kThesisCompared = 19.35, kThesisSingle = 19.37, kThesisTemporal = 17.54;

Nyu2Error addErrors(const Nyu2Error& a, const Nyu2Error& b) {
  return {a.all + b.all, a.annotated + b.annotated};
}

Nyu2Error meanError(const Nyu2Error& total, int count) {
  return {total.all / count, total.annotated / count};
}

const Nyu2Point* pointOf(std::span<const Nyu2Point> curve, int frames) {
  const auto found = std::ranges::find(curve, frames, &Nyu2Point::frames);
  return found == curve.end() ? nullptr : &*found;
}

/// A stream whose numbers have a decimal point in every locale.
std::ostringstream numberStream(int digits) {
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  stream << std::fixed << std::setprecision(digits);
  return stream;
}

}  // namespace

cv::Mat1i nyuInstances(const cv::Mat1w& labels, const cv::Mat1w& instances) {
  SCANTROVE_CHECK(labels.size() == instances.size());
  using Pair = std::pair<std::uint16_t, std::uint16_t>;
  std::set<Pair> pairs;
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      if (labels(y, x) != 0) pairs.emplace(labels(y, x), instances(y, x));
    }
  }
  std::map<Pair, int> numbers;
  for (const Pair& pair : pairs) numbers.emplace(pair, static_cast<int>(numbers.size()) + 1);
  cv::Mat1i truth(labels.size(), 0);
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      if (labels(y, x) != 0) truth(y, x) = numbers.at({labels(y, x), instances(y, x)});
    }
  }
  return truth;
}

Nyu2Error nyu2Error(const cv::Mat1i& segmentation, const cv::Mat1i& truth) {
  const cv::Mat1b segment_boundary = boundaryPixels(segmentation), truth_boundary = boundaryPixels(truth);
  const cv::Mat1b everywhere(truth.size(), 255);
  cv::Mat1b labeled;
  cv::compare(truth, 0, labeled, cv::CMP_NE);
  return {boundaryError(segment_boundary, truth_boundary, everywhere),
          boundaryError(segment_boundary, truth_boundary, labeled)};
}

std::vector<Nyu2Point> nyu2Curve(std::span<const Nyu2Image> images, std::span<const int> lengths) {
  std::vector<Nyu2Point> curve;
  for (const int frames : lengths) curve.emplace_back().frames = frames;
  for (const Nyu2Image& image : images) {
    if (!std::ranges::all_of(lengths, [&](int frames) { return image.contains(frames); })) continue;
    for (Nyu2Point& point : curve) {
      const Nyu2Outcome& outcome = image.at(point.frames);
      ++point.images;
      point.lost += outcome.is_lost ? 1 : 0;
      point.single = addErrors(point.single, outcome.single);
      point.merged = addErrors(point.merged, outcome.merged);
    }
  }
  if (curve.empty() || curve.front().images == 0) return {};
  for (Nyu2Point& point : curve) {
    point.single = meanError(point.single, point.images);
    point.merged = meanError(point.merged, point.images);
  }
  return curve;
}

std::string nyu2Table(std::span<const Nyu2Point> curve) {
  const Nyu2Point* const single = pointOf(curve, 1);
  const Nyu2Point* const temporal = pointOf(curve, kNyu2TableScan);
  if (single == nullptr || temporal == nullptr) return {};
  std::ostringstream table = numberStream(2);
  const auto row = [&](const std::string& method, const std::string& thesis, const std::string& here) {
    table << std::left << std::setw(36) << method << std::right << std::setw(8) << thesis << std::setw(8)
          << here << '\n';
  };
  const auto text = [](double value) {
    std::ostringstream number = numberStream(2);
    number << value;
    return number.str();
  };
  row("Error 4.1 (pixels)", "thesis", "here");
  row("[20] of the thesis", text(kThesisCompared), "-");
  row("single frame", text(kThesisSingle), text(single->single.all));
  row("temporal, " + std::to_string(kNyu2TableScan) + " frames", text(kThesisTemporal),
      text(temporal->merged.all));
  row("temporal / single", text(kThesisTemporal / kThesisSingle),
      single->single.all > 0 ? text(temporal->merged.all / single->single.all) : "-");
  return table.str();
}

std::string nyu2Csv(std::span<const Nyu2Point> curve) {
  std::ostringstream csv = numberStream(4);
  csv << "frames,images,lost,merged_error,single_error,merged_error_annotated,single_error_annotated\n";
  for (const Nyu2Point& point : curve) {
    csv << point.frames << ',' << point.images << ',' << point.lost << ',' << point.merged.all << ','
        << point.single.all << ',' << point.merged.annotated << ',' << point.single.annotated << '\n';
  }
  return csv.str();
}

}  // namespace scantrove
