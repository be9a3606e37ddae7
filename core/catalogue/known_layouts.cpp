#include "core/catalogue/known_layouts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace scantrove {
namespace {

/// Minimum height of a triangle of three objects, relative to its longest side: nearly collinear ones fix
/// no rotation.
constexpr float kMinHeightRatio = 0.15F;
/// Maximum number of pairs tried together.
constexpr std::size_t kMaxPairs = 48;

/// One object in a session's world and in this scan's.
struct Pair {
  Eigen::Vector3f then, now;
};

Eigen::Isometry3f fitted(const std::vector<Pair>& pairs) {
  Eigen::Matrix3Xd then(3, static_cast<Eigen::Index>(pairs.size())), now(then);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    then.col(static_cast<Eigen::Index>(i)) = pairs[i].then.cast<double>();
    now.col(static_cast<Eigen::Index>(i)) = pairs[i].now.cast<double>();
  }
  return Eigen::Isometry3d(Eigen::umeyama(then, now, false)).cast<float>();
}

std::vector<Pair> near(const std::vector<Pair>& pairs, const Eigen::Isometry3f& T_now_then) {
  std::vector<Pair> found;
  std::ranges::copy_if(pairs, std::back_inserter(found), [&](const Pair& pair) {
    return (T_now_then * pair.then - pair.now).norm() < KnownLayouts::kNear_m;
  });
  return found;
}

bool areAsFarApart(const Pair& a, const Pair& b) {
  return std::abs((a.then - b.then).norm() - (a.now - b.now).norm()) < KnownLayouts::kNear_m;
}

bool isWide(const Pair& a, const Pair& b, const Pair& c) {
  const Eigen::Vector3f ab = b.then - a.then, bc = c.then - b.then, ca = a.then - c.then;
  const float longest_m = std::max({ab.norm(), bc.norm(), ca.norm()});
  return ab.cross(ca).norm() >= kMinHeightRatio * longest_m;
}

/// The largest set that agrees with a transform of three pairs; stops at three quarters of all.
std::vector<Pair> agreeing(const std::vector<Pair>& pairs) {
  std::vector<Pair> best;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!areAsFarApart(pairs[i], pairs[j])) continue;
      for (std::size_t k = 0; k < j; ++k) {
        if (!areAsFarApart(pairs[i], pairs[k]) || !areAsFarApart(pairs[j], pairs[k]) ||
            !isWide(pairs[i], pairs[j], pairs[k]))
          continue;
        std::vector<Pair> found = near(pairs, fitted({pairs[i], pairs[j], pairs[k]}));
        if (found.size() > best.size()) best = std::move(found);
        if (4 * best.size() >= 3 * pairs.size()) return best;
      }
    }
  }
  return best;
}

/// The transform that most pairs agree on; none: too few agree.
std::optional<Eigen::Isometry3f> agreedOn(const std::vector<Pair>& pairs) {
  const std::size_t needed = std::max<std::size_t>(KnownLayouts::kMinObjects, (pairs.size() + 2) / 3);
  const std::vector<Pair> best = agreeing(pairs);
  if (best.size() < needed) return std::nullopt;
  const Eigen::Isometry3f T_now_then = fitted(best);
  const std::vector<Pair> all = near(pairs, T_now_then);
  return all.size() < needed ? T_now_then : fitted(all);
}

}  // namespace

void KnownLayouts::add(std::int64_t session, ObjectId object, const Eigen::Vector3f& centroid_world) {
  Sightings& seen = sessions_[session][object];
  seen.least = seen.count == 0 ? centroid_world : seen.least.cwiseMin(centroid_world);
  seen.most = seen.count == 0 ? centroid_world : seen.most.cwiseMax(centroid_world);
  seen.sum += centroid_world;
  ++seen.count;
}

void KnownLayouts::align(const std::vector<ObjectPosition>& recognized, const MergeRootOf& merge_root_of) {
  expected_.clear();
  if (recognized.size() < kMinObjects) return;
  for (const auto& [session, objects] : sessions_) {
    std::vector<ObjectPosition> then;  // by merge root
    for (const auto& [object, seen] : objects) {
      const ObjectId root = merge_root_of(object);
      if (root && !seen.haveMoved()) then.push_back({root, seen.mean()});
    }
    std::vector<Pair> pairs;
    for (const ObjectPosition& now : recognized) {
      for (const ObjectPosition& earlier : then) {
        if (earlier.object == now.object) pairs.push_back({earlier.centroid_world, now.centroid_world});
      }
    }
    if (pairs.size() > kMaxPairs) pairs.resize(kMaxPairs);
    const std::optional<Eigen::Isometry3f> T_now_then = agreedOn(pairs);
    if (!T_now_then) continue;
    for (const ObjectPosition& earlier : then)
      expected_.push_back({earlier.object, *T_now_then * earlier.centroid_world});
  }
}

std::vector<ObjectId> KnownLayouts::expectedAt(const Eigen::Vector3f& centroid_world) const {
  std::vector<std::pair<float, ObjectId>> there;
  for (const ObjectPosition& position : expected_) {
    const float distance_m = (position.centroid_world - centroid_world).norm();
    if (distance_m < kExpected_m) there.emplace_back(distance_m, position.object);
  }
  std::ranges::sort(there);
  std::vector<ObjectId> objects;
  for (const auto& [distance_m, object] : there) {
    if (!std::ranges::count(objects, object)) objects.push_back(object);
  }
  return objects;
}

}  // namespace scantrove
