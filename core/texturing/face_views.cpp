#include "core/texturing/face_views.h"

#include <algorithm>
#include <limits>
#include <map>

namespace scantrove {
namespace {

constexpr float kEdgeCost = 0.25F;
constexpr int kFacePasses = 10, kPatchPasses = 6;
constexpr float kImpossible = std::numeric_limits<float>::infinity();

class ViewLabeling {
 public:
  ViewLabeling(const ViewRatings& ratings, const FaceNeighbors& neighbors)
      : ratings_(ratings), neighbors_(neighbors), views_(ratings.faces(), kNoView) {
    for (std::uint32_t face = 0; face < views_.size(); ++face) {
      if (const auto own = ratings.of(face); !own.empty()) views_[face] = own.front().view;
    }
  }

  /// Whether a face changed its view.
  bool improveFaces() {
    bool is_changed = false;
    for (std::uint32_t face = 0; face < views_.size(); ++face) {
      if (views_[face] == kNoView) continue;
      ViewNumber best = views_[face];
      float best_cost = costOf(face, best);
      for (const std::uint32_t neighbor : neighbors_[face]) {
        if (neighbor == kNoFace || views_[neighbor] == kNoView) continue;
        const float cost = costOf(face, views_[neighbor]);
        if (cost < best_cost) {
          best_cost = cost;
          best = views_[neighbor];
        }
      }
      is_changed |= best != views_[face];
      views_[face] = best;
    }
    return is_changed;
  }

  /// Whether a patch changed its view.
  bool improvePatches() {
    bool is_changed = false;
    std::vector<bool> is_done(views_.size(), false);
    for (std::uint32_t seed = 0; seed < views_.size(); ++seed) {
      if (is_done[seed] || views_[seed] == kNoView) continue;
      const std::vector<std::uint32_t> patch = patchOf(seed);
      for (const std::uint32_t face : patch) is_done[face] = true;
      const ViewNumber best = bestViewOf(patch);
      if (best == views_[seed]) continue;
      for (const std::uint32_t face : patch) views_[face] = best;
      is_changed = true;
    }
    return is_changed;
  }

  [[nodiscard]] std::vector<ViewNumber> take() && { return std::move(views_); }

 private:
  [[nodiscard]] float dataCost(std::uint32_t face, ViewNumber view) const {
    const auto own = ratings_.of(face);
    const auto found = std::ranges::find(own, view, &ViewRatings::Rating::view);
    return found == own.end() ? kImpossible : 1 - found->quality / own.front().quality;
  }

  [[nodiscard]] float costOf(std::uint32_t face, ViewNumber view) const {
    float cost = dataCost(face, view);
    for (const std::uint32_t neighbor : neighbors_[face]) {
      if (neighbor != kNoFace && views_[neighbor] != kNoView && views_[neighbor] != view) cost += kEdgeCost;
    }
    return cost;
  }

  [[nodiscard]] std::vector<std::uint32_t> patchOf(std::uint32_t seed) {
    const ViewNumber view = views_[seed];
    std::vector<std::uint32_t> patch{seed};
    views_[seed] = kNoView;  // marks it as found
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (const std::uint32_t neighbor : neighbors_[patch[i]]) {
        if (neighbor == kNoFace || views_[neighbor] != view) continue;
        views_[neighbor] = kNoView;
        patch.push_back(neighbor);
      }
    }
    for (const std::uint32_t face : patch) views_[face] = view;
    return patch;
  }

  /// The view of an adjacent patch if it costs less than that of the patch.
  [[nodiscard]] ViewNumber bestViewOf(const std::vector<std::uint32_t>& patch) const {
    const ViewNumber own = views_[patch.front()];
    std::map<ViewNumber, float> costs;  // less that of the own view
    for (const std::uint32_t face : patch) {
      for (const std::uint32_t neighbor : neighbors_[face]) {
        if (neighbor != kNoFace && views_[neighbor] != own && views_[neighbor] != kNoView)
          costs[views_[neighbor]] -= kEdgeCost;
      }
    }
    ViewNumber best = own;
    float best_cost = 0;
    for (auto [view, cost] : costs) {
      for (std::size_t i = 0; i < patch.size() && cost < kImpossible; ++i)
        cost += dataCost(patch[i], view) - dataCost(patch[i], own);
      if (cost < best_cost) {
        best_cost = cost;
        best = view;
      }
    }
    return best;
  }

  const ViewRatings& ratings_;
  const FaceNeighbors& neighbors_;
  std::vector<ViewNumber> views_;
};

}  // namespace

std::vector<ViewNumber> chooseFaceViews(const ViewRatings& ratings, const FaceNeighbors& neighbors) {
  ViewLabeling labeling(ratings, neighbors);
  for (int pass = 0; pass < kFacePasses && labeling.improveFaces(); ++pass) {
  }
  for (int pass = 0; pass < kPatchPasses && labeling.improvePatches(); ++pass) {
  }
  return std::move(labeling).take();
}

}  // namespace scantrove
