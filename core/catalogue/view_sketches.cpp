#include "core/catalogue/view_sketches.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/catalogue/match_distance.h"

namespace scantrove {
namespace {

constexpr std::size_t kShapeNumbers = ViewSketch::kEven + ViewSketch::kOdd;
constexpr float kUnitSquared = static_cast<float>(ViewSketch::kUnit) * static_cast<float>(ViewSketch::kUnit);
/// Sums of products have their upper 16 bits alone.
constexpr float kProduct = 65536 / kUnitSquared;
/// Squared Hellinger distance of views without colours to all others. Less than the usual 0.8, because they
/// must not be missed.
constexpr float kUnknownColors = 0.4F;

float energyOfNumbers(std::span<const std::int16_t> numbers) {
  float energy = 0;
  for (const std::int16_t number : numbers)
    energy += static_cast<float>(number) * static_cast<float>(number) / kUnitSquared;
  return energy;
}

template <std::size_t kCount>
using Floats = std::array<float, kCount>;

/// Views whose sums stay in registers.
constexpr std::size_t kOfGroup = 16;
/// A number of the query, as often as there are views in a group.
using Repeated = std::array<std::int16_t, kOfGroup>;

/// Sums of the products of the query's numbers with those of views that lie side by side. Both vectors have
/// at most length 1, so the sums fit into 16 bits.
template <std::size_t kNumbers, std::size_t kCount>
Floats<kCount> sumProducts(const std::array<std::int16_t, kCount>* numbers, const Repeated* query) {
  static_assert(kCount % kOfGroup == 0);
  Floats<kCount> sums;
  constexpr float kRounding = 0.5F * static_cast<float>(kNumbers);  // each product was rounded down
  for (std::size_t group = 0; group < kCount; group += kOfGroup) {
    std::array<std::int16_t, kOfGroup> total{};
    for (std::size_t k = 0; k < kNumbers; ++k) {
      for (std::size_t lane = 0; lane < kOfGroup; ++lane) {
        const int product = (numbers[k][group + lane] * query[k][lane]) >> 16;
        total[lane] = static_cast<std::int16_t>(total[lane] + static_cast<std::int16_t>(product));
      }
    }
    for (std::size_t lane = 0; lane < kOfGroup; ++lane)
      sums[group + lane] = (static_cast<float>(total[lane]) + kRounding) * kProduct;
  }
  return sums;
}

}  // namespace

/// What is the same for all views.
struct ViewSketches::Query {
  explicit Query(const ViewSketch& of)
      : sketch(of),
        shape_energy(energyOfNumbers(std::span(of.numbers).first(kShapeNumbers)) * of.length * of.length),
        color_energy(energyOfNumbers(std::span(of.numbers).last(ViewSketch::kColors))),
        weights(matchWeights(of.has_colors)) {
    for (std::size_t k = 0; k < repeated.size(); ++k) repeated[k].fill(of.numbers[k]);
  }

  const ViewSketch& sketch;
  float shape_energy, color_energy;
  MatchWeights weights;
  std::array<Repeated, ViewSketch::kNumbers> repeated;  // the sketch's numbers
};

void ViewSketches::append(const ViewSketch& sketch) {
  const std::size_t lane = static_cast<std::size_t>(size_) % kLanes;
  if (lane == 0) blocks_.emplace_back();
  Block& block = blocks_.back();
  const Query energies(sketch);
  for (std::size_t k = 0; k < ViewSketch::kNumbers; ++k) block.numbers[k][lane] = sketch.numbers[k];
  block.length[lane] = sketch.length;
  block.shape_energy[lane] = energies.shape_energy;
  block.color_energy[lane] = sketch.has_colors ? energies.color_energy : kUnknownColors;
  block.has_size[lane] = sketch.has_size ? 1.0F : 0.0F;
  for (std::size_t i = 0; i < 4; ++i) block.log_sizes[i][lane] = sketch.log_sizes[i];
  ++size_;
}

// Loops over lanes that write to local arrays alone: so the compiler turns them into vector instructions at
// -O2 and without those of newer processors.
void ViewSketches::compare(const Block& block, const Query& query, Compared& compared) {
  const Repeated* numbers = query.repeated.data();
  const Lanes<float> even = sumProducts<ViewSketch::kEven, kLanes>(block.numbers.data(), numbers);
  const Lanes<float> odd = sumProducts<ViewSketch::kOdd, kLanes>(block.numbers.data() + ViewSketch::kEven,
                                                                 numbers + ViewSketch::kEven);
  const Lanes<float> colors =
      sumProducts<ViewSketch::kColors, kLanes>(block.numbers.data() + kShapeNumbers, numbers + kShapeNumbers);
  Lanes<float> shape, size, distance;
  const float length = query.sketch.length, energy = length * length + 1;  // 1: never divides by zero
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    // The better of the query and its mirror image.
    const float product = (even[lane] + std::abs(odd[lane])) * length * block.length[lane];
    const float difference = query.shape_energy + block.shape_energy[lane] - 2 * product;
    shape[lane] = 2 * difference / (energy + block.length[lane] * block.length[lane]);
  }
  const std::array<float, 4>& sizes = query.sketch.log_sizes;
  const float is_known = query.sketch.has_size ? 1.0F : 0.0F;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const float sum =
        std::abs(block.log_sizes[0][lane] - sizes[0]) + std::abs(block.log_sizes[1][lane] - sizes[1]) +
        std::abs(block.log_sizes[2][lane] - sizes[2]) + std::abs(block.log_sizes[3][lane] - sizes[3]);
    size[lane] = sum * is_known * block.has_size[lane];
  }
  const MatchWeights weights = query.weights;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const float color = (query.color_energy + block.color_energy[lane]) / 2 - colors[lane];
    const float beyond = size[lane] - weights.size_of_noise;
    distance[lane] = weights.shape * shape[lane] + weights.colors * color + weights.size * size[lane] +
                     weights.other_size * (beyond + std::abs(beyond)) / 2;
  }
  compared.shape = shape;
  compared.distance = distance;
}

std::vector<ViewSketches::Near> ViewSketches::nearest(const ViewSketch& sketch, std::size_t most,
                                                      const std::function<bool(int)>& counts) const {
  const Query query(sketch);
  std::vector<Near> near;
  float limit = std::numeric_limits<float>::infinity();  // of what may still be among the nearest
  const auto keepNearest = [&] {
    if (near.size() <= most) return;
    const auto end = near.begin() + static_cast<std::ptrdiff_t>(most);
    std::ranges::nth_element(near, end, {},
                             [](const Near& one) { return std::pair(one.distance, one.place); });
    limit = end->distance;
    near.erase(end, near.end());
  };
  Compared compared;
  int place = 0;
  for (const Block& block : blocks_) {
    compare(block, query, compared);
    for (std::size_t lane = 0; lane < kLanes && place < size_; ++lane, ++place) {
      if (compared.distance[lane] >= limit || !counts(place)) continue;
      near.push_back({compared.distance[lane], compared.shape[lane], place});
    }
    if (near.size() >= 2 * most + kLanes) keepNearest();
  }
  keepNearest();
  return near;
}

std::vector<ViewSketches::Near> ViewSketches::at(const ViewSketch& sketch,
                                                 std::span<const int> places) const {
  const Query query(sketch);
  std::vector<Near> near;
  near.reserve(places.size());
  Compared compared;
  std::size_t last = blocks_.size();
  for (const int place : places) {
    const std::size_t block = static_cast<std::size_t>(place) / kLanes;
    const std::size_t lane = static_cast<std::size_t>(place) % kLanes;
    if (block != last) compare(blocks_[block], query, compared);
    last = block;
    near.push_back({compared.distance[lane], compared.shape[lane], place});
  }
  return near;
}

}  // namespace scantrove
