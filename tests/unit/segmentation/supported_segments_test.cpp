#include "core/segmentation/supported_segments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

#include "tests/unit/segmentation/table_scene.h"

namespace scantrove {
namespace {

using test::TableScene;
using RoleKind = SegmentRole::Kind;

const Eigen::Vector3f kTableColor(80, 5, 10), kBoxColor(50, -40, 20), kThingColor(40, 40, -30);

/// A table with a box on it, to paint and to make holes in. Rectangles are in pixels.
struct TableFrame {
  static constexpr std::uint32_t kBox = 2;  ///< by depth
  SegmentMap segments;
  std::vector<Eigen::Vector3f> lab;

  explicit TableFrame(bool with_box = true) {
    TableScene scene;
    if (with_box) scene.addBox({-0.25, -0.05, 0}, {-0.13, 0.05, 0.08});
    segments = scene.segments();
    for (const std::uint32_t id : segments.ids) lab.push_back(id == kBox ? kBoxColor : kTableColor);
  }

  void forEach(const cv::Rect& where, const auto& visit) const {
    for (int v = where.y; v < where.br().y; ++v)
      for (int u = where.x; u < where.br().x; ++u) visit(TableScene::kCamera.indexOf(u, v));
  }
  TableFrame& paint(const cv::Rect& where, const Eigen::Vector3f& color) {
    forEach(where, [&](std::size_t pixel) { lab[pixel] = color; });
    return *this;
  }
  TableFrame& removeDepth(const cv::Rect& where) {
    forEach(where, [&](std::size_t pixel) { setSegment(pixel, 0, 0); });
    return *this;
  }
  /// Makes the rectangle one segment of its own by depth.
  TableFrame& addSegment(const cv::Rect& where) {
    const auto id = static_cast<std::uint32_t>(segments.areas.size());
    segments.areas.push_back(0);
    forEach(where, [&](std::size_t pixel) { setSegment(pixel, id, segments.depths_m[pixel]); });
    return *this;
  }

  [[nodiscard]] SegmentMap segmented() const {
    SegmentMap result = segments;
    segmentOnSupports(findSupports(result, TableScene::kCamera), lab, TableScene::kCamera, result);
    return result;
  }
  [[nodiscard]] SegmentMap segmentedWithoutColor() const {
    SegmentMap result = segments;
    segmentOnSupports(findSupports(result, TableScene::kCamera), {}, TableScene::kCamera, result);
    return result;
  }

 private:
  void setSegment(std::size_t pixel, std::uint32_t id, float z_m) {
    --segments.areas[segments.ids[pixel]];
    ++segments.areas[id];
    segments.ids[pixel] = id;
    segments.depths_m[pixel] = z_m;
  }
};

// Places on the table, away from the box and from each other.
const cv::Rect kSheet(200, 40, 40, 30), kHole(200, 150, 30, 24), kOtherHole(60, 180, 20, 20);

std::uint32_t segmentAt(const SegmentMap& map, int u, int v) {
  return map.ids[TableScene::kCamera.indexOf(u, v)];
}
std::uint32_t segmentIn(const SegmentMap& map, const cv::Rect& where) {
  return segmentAt(map, where.x + where.width / 2, where.y + where.height / 2);
}
std::uint32_t tableSegment(const SegmentMap& map) { return segmentAt(map, 2, 2); }

void expectOneSegment(const SegmentMap& map, const std::vector<std::size_t>& pixels) {
  ASSERT_FALSE(pixels.empty());
  const std::uint32_t id = map.ids[pixels[0]];
  EXPECT_NE(id, 0U);
  EXPECT_EQ(map.areas[id], static_cast<int>(pixels.size())) << "nothing else is in the segment";
  for (const std::size_t pixel : pixels) ASSERT_EQ(map.ids[pixel], id) << pixel;
}

std::vector<std::size_t> pixelsOfRectangle(const TableFrame& frame, const cv::Rect& where) {
  std::vector<std::size_t> pixels;
  frame.forEach(where, [&](std::size_t pixel) { pixels.push_back(pixel); });
  return pixels;
}

std::vector<std::size_t> pixelsOfSegment(const SegmentMap& map, std::uint32_t id) {
  std::vector<std::size_t> pixels;
  for (std::size_t pixel = 0; pixel < map.ids.size(); ++pixel)
    if (map.ids[pixel] == id) pixels.push_back(pixel);
  return pixels;
}

void expectSameSegments(const SegmentMap& a, const SegmentMap& b) {
  EXPECT_EQ(a.ids, b.ids);
  EXPECT_EQ(a.areas, b.areas);
  EXPECT_EQ(a.depths_m, b.depths_m);
  EXPECT_EQ(std::ranges::count(a.is_estimated, 1), std::ranges::count(b.is_estimated, 1));
}

TEST(SegmentOnSupports, FlatSheetIsOneCarriedSegment_WhenItsColorDiffers) {
  TableFrame frame;
  frame.paint(kSheet, kThingColor);
  ASSERT_EQ(segmentIn(frame.segments, kSheet), tableSegment(frame.segments)) << "depth does not show it";
  const SegmentMap map = frame.segmented();
  expectOneSegment(map, pixelsOfRectangle(frame, kSheet));
  const SegmentRole sheet = map.roleOf(segmentIn(map, kSheet)), table = map.roleOf(tableSegment(map));
  EXPECT_EQ(sheet.kind, RoleKind::carried);
  EXPECT_EQ(table.kind, RoleKind::support);
  EXPECT_EQ(sheet.support, table.support);
  EXPECT_EQ(map.depths_m, frame.segments.depths_m);
  EXPECT_EQ(std::ranges::count(map.is_estimated, 1), 0) << "all pixels are measured";
}

// A cloth differs from the table; what lies on it differs from the cloth, not always from the table.
TEST(SegmentOnSupports, ThingsOnAClothAreSegmentsOfTheirOwn) {
  TableFrame frame;
  const cv::Rect cloth(30, 40, 230, 150), paper(160, 60, 40, 30);
  frame.forEach(cloth, [&](std::size_t pixel) {
    if (frame.segments.ids[pixel] != TableFrame::kBox) frame.lab[pixel] = kThingColor;
  });
  frame.paint(paper, kTableColor);
  const SegmentMap map = frame.segmented();
  const std::uint32_t of_cloth = segmentAt(map, cloth.x + 5, cloth.y + 5), of_paper = segmentIn(map, paper);
  EXPECT_EQ(map.roleOf(of_cloth).kind, RoleKind::carrier);
  EXPECT_EQ(map.roleOf(tableSegment(map)).kind, RoleKind::support);
  EXPECT_EQ(map.roleOf(of_cloth).support, map.roleOf(tableSegment(map)).support);
  expectOneSegment(map, pixelsOfRectangle(frame, paper));
  EXPECT_EQ(map.roleOf(of_paper).kind, RoleKind::carried);
  EXPECT_EQ(map.areas[of_cloth],
            cloth.area() - paper.area() -
                static_cast<int>(pixelsOfSegment(frame.segments, TableFrame::kBox).size()));
}

TEST(SegmentOnSupports, SheetUnderABoxIsOneSegment) {
  TableFrame frame;
  const cv::Rect sheet(80, 80, 70, 60), picture(125, 90, 18, 18);  // 0.05 m^2
  frame.forEach(sheet, [&](std::size_t pixel) {
    if (frame.segments.ids[pixel] != TableFrame::kBox) frame.lab[pixel] = kThingColor;
  });
  frame.paint(picture, kTableColor);
  const SegmentMap map = frame.segmented();
  EXPECT_EQ(segmentIn(map, picture), segmentAt(map, sheet.br().x - 3, sheet.br().y - 3));
  EXPECT_EQ(map.roleOf(segmentIn(map, picture)).kind, RoleKind::carried);
}

TEST(SegmentOnSupports, HoleInDepthIsACarriedSegment_WhenItsColorDiffers) {
  TableFrame frame;
  frame.paint(kHole, kThingColor).removeDepth(kHole);
  const SegmentMap map = frame.segmented();
  expectOneSegment(map, pixelsOfRectangle(frame, kHole));
  EXPECT_EQ(map.roleOf(segmentIn(map, kHole)).kind, RoleKind::carried);
  ASSERT_EQ(map.is_estimated.size(), map.ids.size());
  EXPECT_EQ(std::ranges::count(map.is_estimated, 1), kHole.area());
  const TableScene table;
  for (const cv::Point& p : {kHole.tl(), kHole.tl() + cv::Point(15, 12), kHole.br() - cv::Point(1, 1)}) {
    const std::size_t pixel = TableScene::kCamera.indexOf(p.x, p.y);
    EXPECT_EQ(map.is_estimated[pixel], 1);
    EXPECT_NEAR(map.depths_m[pixel], table.tableDepth(p.x, p.y), 0.01) << p;
  }
}

TEST(SegmentOnSupports, HoleInDepthIsOfTheSupport_WhenItLooksLikeIt) {
  TableFrame frame;
  frame.removeDepth(kOtherHole);
  const SegmentMap map = frame.segmented();
  for (const std::size_t pixel : pixelsOfRectangle(frame, kOtherHole)) {
    ASSERT_EQ(map.ids[pixel], tableSegment(map));
    ASSERT_EQ(map.is_estimated[pixel], 1);
  }
  EXPECT_EQ(map.roleOf(tableSegment(map)).kind, RoleKind::support);
  EXPECT_EQ(std::ranges::count(map.is_estimated, 1), kOtherHole.area());
  EXPECT_NEAR(map.depths_m[TableScene::kCamera.indexOf(70, 190)], TableScene().tableDepth(70, 190), 0.01);
}

TEST(SegmentOnSupports, RaisedBoxKeepsItsSegment_WhenItIsComplete) {
  const TableFrame frame;
  const SegmentMap map = frame.segmented();
  const std::vector<std::size_t> box = pixelsOfSegment(frame.segments, TableFrame::kBox);
  expectOneSegment(map, box);
  EXPECT_NE(map.ids[box[0]], tableSegment(map));
  EXPECT_EQ(map.count(), 2);
  EXPECT_EQ(map.depths_m, frame.segments.depths_m);
}

TEST(SegmentOnSupports, PartOfABoxWithoutDepthTakesItsHeight) {
  TableFrame frame;
  const SegmentMap complete = frame.segments;
  const cv::Point top = TableScene::pixelOf({-0.19, 0, 0.08});
  const cv::Rect gap(top.x - 6, top.y - 6, 13, 13);
  frame.removeDepth(gap);
  const SegmentMap map = frame.segmented();
  const std::uint32_t id = segmentIn(map, gap);
  int in_box = 0;
  for (const std::size_t pixel : pixelsOfSegment(complete, TableFrame::kBox))
    in_box += map.ids[pixel] == id ? 1 : 0;
  EXPECT_EQ(map.areas[id], in_box) << "nothing else is in the segment";
  EXPECT_GT(in_box, 0.9 * complete.areas[TableFrame::kBox]) << "but for pixels at its foot";
  EXPECT_EQ(map.roleOf(id).kind, RoleKind::carried);
  for (const std::size_t pixel : pixelsOfRectangle(frame, gap)) {
    ASSERT_EQ(map.ids[pixel], id);
    ASSERT_EQ(map.is_estimated[pixel], 1);
    ASSERT_NEAR(map.depths_m[pixel], complete.depths_m[pixel], 0.003);
  }
}

TEST(SegmentOnSupports, ShadowIsOfTheSupport_OnlyBesideATallObject) {
  const Eigen::Vector3f shadow = 0.55F * kTableColor;
  const cv::Rect beside_box(126, 100, 9, 24), elsewhere(250, 100, 9, 24);
  TableFrame frame;
  frame.paint(beside_box, shadow).paint(elsewhere, shadow);
  ASSERT_EQ(segmentAt(frame.segments, 126, 123), TableScene::kTable);
  const SegmentMap map = frame.segmented();
  EXPECT_EQ(segmentIn(map, beside_box), tableSegment(map));
  EXPECT_NE(segmentIn(map, elsewhere), tableSegment(map)) << "a dark object";
}

TEST(SegmentOnSupports, SmallSegmentsInTheSupportJoinIt) {
  const cv::Rect small(200, 40, 10, 10), large(250, 40, 20, 20);
  TableFrame frame;
  frame.addSegment(small).addSegment(large);
  const SegmentMap map = frame.segmented();
  EXPECT_EQ(segmentIn(map, small), tableSegment(map));
  EXPECT_NE(segmentIn(map, large), tableSegment(map));
  expectOneSegment(map, pixelsOfRectangle(frame, large));
}

TEST(SegmentOnSupports, ColorAloneChangesNothing_WithoutASupport) {
  TableFrame frame(false);
  frame.paint(kSheet, kThingColor).paint(kHole, kThingColor).removeDepth(kHole).removeDepth(kOtherHole);
  const SegmentMap map = frame.segmented();
  expectSameSegments(map, frame.segments);
  EXPECT_TRUE(map.roles.empty());
}

TEST(SegmentOnSupports, SegmentsStayAsTheyWere_WithoutColor) {
  TableFrame frame;
  frame.paint(kSheet, kThingColor).removeDepth(kHole);
  const SegmentMap map = frame.segmentedWithoutColor();
  expectSameSegments(map, frame.segments);
  EXPECT_EQ(map.roleOf(tableSegment(map)).kind, RoleKind::support) << "height shows it";
}

TEST(SegmentOnSupports, SegmentsStayAsTheyWere_WhenTheCameraIsOfAnotherSize) {
  const TableFrame frame;
  SegmentMap map = frame.segments;
  const Intrinsics small = TableScene::kCamera.resizedTo(160, 120);
  segmentOnSupports(findSupports(map, TableScene::kCamera), frame.lab, small, map);
  expectSameSegments(map, frame.segments);
  EXPECT_TRUE(map.roles.empty());
}

TEST(SegmentOnSupports, SegmentsAreCountedAndNumberedByTheirFirstPixel) {
  TableFrame frame;
  frame.paint(kSheet, kThingColor).paint(kHole, kThingColor).removeDepth(kHole).removeDepth(kOtherHole);
  const SegmentMap map = frame.segmented();
  std::vector<int> areas(static_cast<std::size_t>(map.count()) + 1, 0);
  std::uint32_t last = 0;
  for (const std::uint32_t id : map.ids) {
    ASSERT_LT(id, areas.size());
    ++areas[id];
    ASSERT_LE(id, last + 1) << "a number was left out";
    last = std::max(last, id);
  }
  EXPECT_EQ(map.areas, areas);
  EXPECT_EQ(map.count(), 4) << "the table, the sheet, the box, and the hole";
  EXPECT_EQ(map.roles.size(), map.areas.size());
  EXPECT_EQ(segmentIn(map, kSheet), 2U) << "it begins above the box";
  EXPECT_EQ(segmentIn(map, kHole), 4U);
}

/// One estimated pixel.
SegmentMap estimatedAt(const Intrinsics& K, int u, int v, float z_m) {
  const auto pixels = static_cast<std::size_t>(K.pixels());
  SegmentMap map{K.width,
                 K.height,
                 std::vector<std::uint32_t>(pixels, 1),
                 {0, K.pixels()},
                 std::vector<float>(pixels, 2),
                 std::vector<std::uint8_t>(pixels, 0)};
  map.depths_m[K.indexOf(u, v)] = z_m;
  map.is_estimated[K.indexOf(u, v)] = 1;
  return map;
}

TEST(AddEstimatedSurface, VertexLiesOnTheRayOfThePixel) {
  const Intrinsics K{60, 61, 31, 23, 64, 48};
  const auto pixels = static_cast<std::size_t>(K.pixels());
  RenderedView view;
  view.K = K;
  view.T_world_camera = test::lookAt({0.3, -0.2, 0.5}, {1, 2, 0.7});
  const Eigen::Vector4f measured(1, 2, 3, 1);
  view.vertices_world.assign(pixels, measured);
  view.normals_world.assign(pixels, Eigen::Vector4f::Zero());
  addEstimatedSurface(estimatedAt(K, 40, 12, 1.5F), view);
  ASSERT_EQ(view.is_estimated.size(), pixels);
  const std::size_t pixel = K.indexOf(40, 12);
  for (std::size_t i = 0; i < pixels; ++i) {
    ASSERT_EQ(view.is_estimated[i], i == pixel ? 1 : 0);
    ASSERT_EQ(view.vertices_world[i] == measured, i != pixel);
  }
  EXPECT_EQ(view.vertices_world[pixel].w(), 1);
  const Eigen::Vector3d p =
      view.T_world_camera.inverse() * Eigen::Vector3d(view.vertices_world[pixel].head<3>().cast<double>());
  EXPECT_NEAR(p.z(), 1.5, 1e-5);
  EXPECT_NEAR(60 * p.x() / p.z() + 31, 40, 1e-3);
  EXPECT_NEAR(61 * p.y() / p.z() + 23, 12, 1e-3);
  EXPECT_TRUE(view.normals_world[pixel].isZero());
}

TEST(AddEstimatedSurface, ViewStaysAsItWas_WithoutEstimatedPixels) {
  const Intrinsics K{60, 61, 31, 23, 64, 48};
  SegmentMap map = estimatedAt(K, 40, 12, 1.5F);
  map.is_estimated.clear();
  RenderedView view;
  view.K = K;
  const auto pixels = static_cast<std::size_t>(K.pixels());
  view.vertices_world.assign(pixels, Eigen::Vector4f::Zero());
  addEstimatedSurface(map, view);
  EXPECT_TRUE(view.is_estimated.empty());
  EXPECT_TRUE(view.vertices_world[K.indexOf(40, 12)].isZero());
}

}  // namespace
}  // namespace scantrove
