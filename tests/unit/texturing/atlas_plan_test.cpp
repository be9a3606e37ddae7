#include "core/texturing/atlas_plan.h"

#include <gtest/gtest.h>

#include <random>

#include "core/texturing/rect_packer.h"
#include "core/texturing/texture_atlas.h"

namespace scantrove::test {
namespace {

void expectApart(const std::vector<cv::Rect>& rects, const cv::Size& bin) {
  cv::Mat taken = cv::Mat::zeros(bin, CV_8UC1);
  for (const cv::Rect& rect : rects) {
    ASSERT_EQ((rect & cv::Rect({}, bin)), rect) << "outside";
    EXPECT_EQ(cv::countNonZero(taken(rect)), 0) << "overlap at " << rect.x << ", " << rect.y;
    taken(rect).setTo(1);
  }
}

TEST(PackRects, PlacesThemApart) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> side(1, 60);
  std::vector<cv::Size> sizes;
  double area = 0;
  while (area < 0.8 * 512 * 512) {
    sizes.emplace_back(side(random), side(random));
    area += sizes.back().area();
  }
  const auto places = packRects(sizes, {512, 512});
  ASSERT_TRUE(places);
  std::vector<cv::Rect> rects;
  for (std::size_t i = 0; i < sizes.size(); ++i) rects.emplace_back((*places)[i], sizes[i]);
  expectApart(rects, {512, 512});
}

TEST(PackRects, SaysWhenTheyDoNotFit) {
  const std::vector<cv::Size> fits{{8, 8}, {8, 8}, {8, 8}, {8, 8}}, wide{{17, 1}};
  EXPECT_TRUE(packRects(fits, {16, 16}));
  EXPECT_FALSE(packRects(fits, {16, 15}));
  EXPECT_FALSE(packRects(wide, {16, 16}));
  EXPECT_TRUE(packRects({}, {1, 1}));
}

/// `count` triangles apart from each other, each in front of the one camera at another place.
struct ManyTriangles {
  TextureSurface surface;
  std::vector<TextureView> views{{{500, 500, 319.5F, 239.5F, 640, 480}, Eigen::Isometry3d::Identity()}};
  std::vector<std::uint32_t> faces;

  ManyTriangles(int count, float side_px) {
    for (int i = 0; i < count; ++i) {
      const auto x = static_cast<float>(10 + (i * 37) % 600), y = static_cast<float>(10 + (i * 53) % 440);
      for (const auto& [dx, dy] : {std::pair{0.0F, 0.0F}, {0.0F, side_px}, {side_px, 0.0F}}) {
        surface.positions_m.push_back(views[0].K.backProject(x + dx, y + dy, 1));
        surface.colors.push_back({10, 20, 30});
      }
      const auto first = static_cast<std::uint32_t>(3 * i);
      surface.faces.push_back({first, first + 1, first + 2});
      faces.push_back(static_cast<std::uint32_t>(i));
    }
  }
};

TEST(PlanAtlas, KeepsChartsApartAndTrianglesWithinThem) {
  const ManyTriangles many(200, 7.3F);
  const FaceNeighbors neighbors = neighborsOf(many.surface.faces);
  std::vector<ViewNumber> face_views(many.faces.size(), 0);
  for (std::size_t i = 0; i < 30; ++i) face_views[i] = kNoView;
  const ViewedSurface viewed{many.surface, many.views, neighbors, face_views};
  for (const int size_px : {256, 512}) {
    TextureCharts cut = cutCharts(viewed, many.faces);
    ASSERT_EQ(cut.charts.size(), 170U);
    ASSERT_EQ(cut.without_view.size(), 30U);
    const auto plan = planAtlas(cut, many.views, size_px, 1);
    ASSERT_TRUE(plan);
    std::vector<cv::Rect> rects;
    for (const AtlasPlan::Place& place : plan->places) rects.push_back(place.rect);
    rects.emplace_back(0, plan->first_cell_row, plan->size.width, plan->size.height - plan->first_cell_row);
    expectApart(rects, plan->size);

    const std::vector<TextureChart> charts = cut.charts;
    const TextureAtlas atlas(viewed, std::move(cut), *plan);
    for (std::size_t chart = 0; chart < charts.size(); ++chart) {
      const auto textures = atlas.textureOf(charts[chart].faces);
      const cv::Rect& rect = plan->places[chart].rect;
      for (const Eigen::Vector2f& corner : textures.front()) {
        // Filters read the four texels around a place.
        const float x = corner.x() * static_cast<float>(plan->size.width);
        const float y = corner.y() * static_cast<float>(plan->size.height);
        EXPECT_GE(x, static_cast<float>(rect.x + kChartPad_px));
        EXPECT_GE(y, static_cast<float>(rect.y + kChartPad_px));
        EXPECT_LE(x, static_cast<float>(rect.br().x - kChartPad_px));
        EXPECT_LE(y, static_cast<float>(rect.br().y - kChartPad_px));
      }
    }
  }
}

TEST(PlanAtlas, UsesAPaletteForManyFacesWithoutAView) {
  const ManyTriangles many(6000, 4);
  const FaceNeighbors neighbors = neighborsOf(many.surface.faces);
  const ViewedSurface viewed{many.surface, many.views, neighbors,
                             std::vector<ViewNumber>(many.faces.size(), kNoView)};
  TextureCharts cut = cutCharts(viewed, many.faces);
  const auto plan = planAtlas(cut, many.views, 256, 1);
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->cell_px, 1);
  const TextureAtlas atlas(viewed, std::move(cut), *plan);
  const auto texture = atlas.textureOf(many.faces).front().front();
  const auto& bgr =
      atlas.image().at<cv::Vec3b>(static_cast<int>(texture.y() * static_cast<float>(plan->size.height)),
                                  static_cast<int>(texture.x() * static_cast<float>(plan->size.width)));
  // A step of the palette is 8 levels wide.
  EXPECT_NEAR(bgr[2], 10, 4);
  EXPECT_NEAR(bgr[1], 20, 4);
  EXPECT_NEAR(bgr[0], 30, 4);
}

TEST(PlanAtlas, GivesUp_WhenChartsDoNotFitAtATenth) {
  const ManyTriangles many(3000, 30);
  const FaceNeighbors neighbors = neighborsOf(many.surface.faces);
  const ViewedSurface viewed{many.surface, many.views, neighbors,
                             std::vector<ViewNumber>(many.faces.size(), 0)};
  EXPECT_FALSE(planAtlas(cutCharts(viewed, many.faces), many.views, 256, 1));
  EXPECT_TRUE(planAtlas(cutCharts(viewed, many.faces, 2), many.views, 256, 1)) << "all without a view";
}

}  // namespace
}  // namespace scantrove::test
