#include "core/labeling/attachments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

#include "core/labeling/graph_merger.h"

namespace scantrove {
namespace {

constexpr int kWidth = 160, kHeight = 120;
constexpr auto kPixels = static_cast<std::size_t>(kWidth) * kHeight;
constexpr int kVoxelsOfObject = 2000, kVoxelsOfRoom = 100'000;
// Segments; each becomes a region.
constexpr std::uint32_t kWall = 1, kBase = 2, kPart = 3, kScreen = 4;

struct Hit {
  float z;
  Eigen::Vector3f normal;
  std::uint32_t segment;
};
using Surface = std::function<std::optional<Hit>(const Eigen::Vector3f& ray)>;  // the ray has z = 1

Surface ball(const Eigen::Vector3f& center, float radius, std::uint32_t segment) {
  return [=](const Eigen::Vector3f& ray) -> std::optional<Hit> {
    const float a = ray.squaredNorm(), b = ray.dot(center), c = center.squaredNorm() - radius * radius;
    const float inside = b * b - a * c;
    if (inside < 0) return std::nullopt;
    const float z = (b - std::sqrt(inside)) / a;
    return Hit{z, (z * ray - center) / radius, segment};
  };
}

/// The part of a plane through `point` with |x| <= half_m and at most 1.3 half_m from `point`.
Surface plate(const Eigen::Vector3f& point, const Eigen::Vector3f& normal, float half_m,
              std::uint32_t segment) {
  return [=, n = normal.normalized().eval()](const Eigen::Vector3f& ray) -> std::optional<Hit> {
    const float z = point.dot(n) / ray.dot(n);
    const Eigen::Vector3f at = z * ray;
    if (!(z > 0) || std::abs(at.x()) > half_m || (at - point).norm() > 1.3F * half_m) return std::nullopt;
    return Hit{z, n, segment};
  };
}

/// A frame of surfaces in front of a wall; each is one segment and one fragment.
struct Scene {
  RenderedView view{{150, 150, (kWidth - 1) / 2.0F, (kHeight - 1) / 2.0F, kWidth, kHeight},
                    Eigen::Isometry3d::Identity(),
                    std::vector<Eigen::Vector4f>(kPixels),
                    std::vector<Eigen::Vector4f>(kPixels),
                    std::vector<FragmentId>(kPixels),
                    {}};
  SegmentMap segments{kWidth, kHeight, std::vector<std::uint32_t>(kPixels), {}, std::vector<float>(kPixels)};
  std::vector<int> voxels = {0};
  RegionTable table;

  explicit Scene(std::vector<Surface> surfaces) {
    surfaces.push_back(plate({0, 0, 1.6F}, {0, 0, -1}, 10, kWall));
    std::vector<FragmentId> fragments = {{}};
    for (std::uint32_t segment = kWall; segment <= kScreen; ++segment) {
      fragments.push_back(table.newFragment());
      voxels.push_back(segment == kWall ? kVoxelsOfRoom : kVoxelsOfObject);
    }
    segments.areas.assign(kScreen + 1, 0);
    for (std::size_t i = 0; i < kPixels; ++i) {
      const std::size_t u = i % kWidth, v = i / kWidth;
      const Eigen::Vector3f ray = view.K.backProject(static_cast<float>(u), static_cast<float>(v), 1);
      std::optional<Hit> nearest;
      for (const Surface& surface : surfaces) {
        const std::optional<Hit> hit = surface(ray);
        if (hit && (!nearest || hit->z < nearest->z)) nearest = hit;
      }
      view.vertices_world[i] = (nearest->z * ray).homogeneous();
      view.normals_world[i] << nearest->normal, 1.0F;
      segments.ids[i] = nearest->segment;
      segments.depths_m[i] = nearest->z;
      ++segments.areas[nearest->segment];
      view.fragments[i] = fragments[nearest->segment];
    }
  }

  [[nodiscard]] MergeInput input() const { return {segments, view, {}, voxels}; }
  [[nodiscard]] RegionId region(std::uint32_t segment) const { return table.regionOf(FragmentId{segment}); }

  /// The attachment of part and base that one frame shows; none if unknown.
  [[nodiscard]] std::optional<bool> areAttached() const {
    RegionMerger::Outcome merged;
    merged.fragments = view.fragments;
    for (const FragmentId fragment : view.fragments) merged.regions.push_back(table.regionOf(fragment));
    for (const Attachment& attachment : findAttachments(input(), merged, table)) {
      if (attachment.a != region(kBase) || attachment.b != region(kPart)) continue;
      EXPECT_THAT(attachment.borders, testing::ElementsAre(std::pair(FragmentId{kBase}, FragmentId{kPart})));
      return attachment.is_attached;
    }
    return std::nullopt;
  }
  /// True if part and base are one region after `frames` frames.
  [[nodiscard]] bool areOneAfter(int frames) {
    GraphMerger merger;
    for (int i = 0; i < frames; ++i) (void)merger.merge(input(), table, LabelingParams());
    return region(kBase) == region(kPart);
  }
};

const Eigen::Vector3f kBelow(0, 0.05F, 1), kAbove(0, -0.08F, 0.98F);
/// A head on a body.
std::vector<Surface> headOnBody() { return {ball(kBelow, 0.1F, kBase), ball(kAbove, 0.06F, kPart)}; }
/// The same ball on a board that is seen from above.
std::vector<Surface> ballOnBoard() {
  return {plate({0, -0.02F, 1}, {0, -0.7F, -0.7F}, 0.2F, kBase), ball(kAbove, 0.06F, kPart)};
}

TEST(Attachments, IsAttached_WhenItTouchesOnlyACurvedRegion) {
  EXPECT_EQ(Scene(headOnBody()).areAttached(), true);
}

TEST(Attachments, IsNotAttached_WhenTheOtherIsFlat) { EXPECT_EQ(Scene(ballOnBoard()).areAttached(), false); }

TEST(Attachments, IsNotAttached_WhenAThirdRegionTouches) {
  std::vector<Surface> surfaces = headOnBody();
  surfaces.push_back(plate({0, 0, 0.95F}, {0, 0, -1}, 0.3F, kScreen));  // base and part both stick out of it
  EXPECT_EQ(Scene(surfaces).areAttached(), false);
}

TEST(Attachments, IsUnknown_WhenHalfHidden) {
  std::vector<Surface> surfaces = headOnBody();
  surfaces.push_back(plate({0, -0.03F, 0.6F}, {0, 0, -1}, 0.024F, kScreen));
  EXPECT_EQ(Scene(surfaces).areAttached(), std::nullopt);
}

TEST(Attachments, IsUnknown_WhenTheOtherIsLargerThanObjects) {
  Scene scene(headOnBody());
  scene.voxels[kBase] = kVoxelsOfRoom;
  EXPECT_EQ(scene.areAttached(), std::nullopt);
}

TEST(Attachments, JoinsRegions_AfterEnoughObservations) {
  EXPECT_FALSE(Scene(headOnBody()).areOneAfter(2)) << "two observations are too few";
  EXPECT_TRUE(Scene(headOnBody()).areOneAfter(40));
  EXPECT_FALSE(Scene(ballOnBoard()).areOneAfter(40));
}

}  // namespace
}  // namespace scantrove
