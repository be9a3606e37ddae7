#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/texturing/face_views.h"
#include "core/texturing/seam_leveling.h"
#include "tests/unit/texturing/textured_box.h"

namespace scantrove::test {
namespace {

/// A box of 40 cm seen from four sides above; nobody sees its bottom.
TexturedBoxes boxInARing() {
  TexturedBoxes boxes;
  boxes.addBox({{-0.2, -0.2, 0}, {0.2, 0.2, 0.4}}, 12);
  for (const auto& [x, y] : {std::pair{1.0, 0.3}, {-0.3, 1.0}, {-1.0, -0.3}, {0.3, -1.0}})
    boxes.addCamera({x, y, 0.9}, {0, 0, 0.2});
  return boxes;
}

bool isAtBottom(const TexturedBoxes& boxes, std::size_t face) {
  return std::ranges::all_of(boxes.scene.surface.faces[face], [&](std::uint32_t vertex) {
    return boxes.scene.surface.positions_m[vertex].z() == 0;
  });
}

Eigen::Vector3d pointOf(const TextureSurface& surface, std::size_t face, const Eigen::Vector3d& weights) {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 3; ++i)
    p += weights[static_cast<int>(i)] * surface.positions_m[surface.faces[face][i]].cast<double>();
  return p;
}

Eigen::Vector2f placeOf(const FaceTexture& texture, const Eigen::Vector3d& weights) {
  Eigen::Vector2f place = Eigen::Vector2f::Zero();
  for (std::size_t i = 0; i < 3; ++i) place += static_cast<float>(weights[static_cast<int>(i)]) * texture[i];
  return place;
}

const std::array<Eigen::Vector3d, 4> kPlaces{Eigen::Vector3d(1.0 / 3, 1.0 / 3, 1.0 / 3),
                                             Eigen::Vector3d(0.9, 0.05, 0.05),
                                             Eigen::Vector3d(0.05, 0.9, 0.05), Eigen::Vector3d(0.5, 0.5, 0)};

TEST(TextureSurface, HasTheColorsOfTheFormula) {
  TexturedBoxes boxes = boxInARing();
  const SurfaceTextures textures = boxes.texture();
  ASSERT_EQ(textures.parts.size(), 1U);
  const PartTexture& part = textures.parts.front();
  ASSERT_EQ(part.textures.size(), boxes.scene.surface.faces.size());
  EXPECT_EQ(textures.faces_without_view, 12U * 12U * 2U) << "the bottom";
  double sum = 0;
  int count = 0;
  for (std::size_t face = 0; face < part.textures.size(); ++face) {
    if (isAtBottom(boxes, face)) continue;
    for (const Eigen::Vector3d& weights : kPlaces) {
      const Eigen::Vector3d truth = colorOfPlace(pointOf(boxes.scene.surface, face, weights));
      const Eigen::Vector3d own = textureColor(part.image, placeOf(part.textures[face], weights));
      // A pixel covers 2.5 mm at 1 m, where the waves change by 80 * 30 * 0.0025 = 6 levels; seen at a slant
      // by three times as many. Edges of the box are half a pixel wide.
      EXPECT_LT((own - truth).cwiseAbs().maxCoeff(), 45) << face;
      sum += (own - truth).cwiseAbs().mean();
      ++count;
    }
  }
  EXPECT_LT(sum / count, 4);
}

TEST(TextureSurface, HasTheColorsOfVertices_WhereNoViewShowsAFace) {
  TexturedBoxes boxes = boxInARing();
  for (std::size_t i = 0; i < boxes.scene.surface.colors.size(); ++i)
    boxes.scene.surface.colors[i] = {static_cast<std::uint8_t>(10 + i % 7), 100, 200};
  const SurfaceTextures textures = boxes.texture();
  const PartTexture& part = textures.parts.front();
  int checked = 0;
  for (std::size_t face = 0; face < part.textures.size(); ++face) {
    if (!isAtBottom(boxes, face)) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& rgb = boxes.scene.surface.colors[boxes.scene.surface.faces[face][i]];
      const Eigen::Vector3d own = textureColor(part.image, part.textures[face][i]);
      EXPECT_NEAR(own[2], rgb[0], 0.51);
      EXPECT_NEAR(own[1], rgb[1], 0.51);
      EXPECT_NEAR(own[0], rgb[2], 0.51);
      ++checked;
    }
  }
  EXPECT_EQ(checked, 12 * 12 * 2 * 3);
}

TEST(TextureSurface, IsTheSame_WhenMadeAgain) {
  TexturedBoxes boxes = boxInARing();
  const SurfaceTextures first = boxes.texture(), second = boxes.texture();
  const PartTexture &a = first.parts.front(), &b = second.parts.front();
  ASSERT_EQ(a.image.size(), b.image.size());
  EXPECT_EQ(cv::norm(a.image, b.image, cv::NORM_INF), 0);
  EXPECT_TRUE(a.textures == b.textures);
}

TEST(TextureSurface, FitsTheGivenSize) {
  TexturedBoxes boxes = boxInARing();
  for (const int size_px : {256, 300, 512}) {
    const SurfaceTextures textures = boxes.texture(size_px);
    const PartTexture& part = textures.parts.front();
    EXPECT_LE(part.image.cols, size_px);
    EXPECT_LE(part.image.rows, size_px);
    double sum = 0;
    for (std::size_t face = 0; face < part.textures.size(); ++face) {
      if (isAtBottom(boxes, face)) continue;
      const Eigen::Vector3d truth = colorOfPlace(pointOf(boxes.scene.surface, face, kPlaces[0]));
      sum += (textureColor(part.image, placeOf(part.textures[face], kPlaces[0])) - truth).cwiseAbs().mean();
    }
    EXPECT_LT(sum / static_cast<double>(part.textures.size()), 12) << size_px;
  }
}

// A wall 30 cm behind a red block: the camera in front sees the block, a camera beside it the wall behind.
TEST(TextureSurface, DoesNotShowTheOccluder_OnAnOccludedFace) {
  TexturedBoxes boxes;
  boxes.addBox({{-0.8, 0.5, -0.6}, {0.8, 0.6, 0.6}}, 20);
  boxes.addBox({{-0.15, 0.1, -0.15}, {0.15, 0.2, 0.15}}, 6);
  boxes.colors = [](std::size_t box, const Eigen::Vector3d& place) {
    return box == 1 ? Eigen::Vector3d(0, 0, 255) : Eigen::Vector3d(colorOfPlace(place).x(), 120, 20);
  };
  boxes.addCamera({0, -0.9, 0}, {0, 1, 0});
  boxes.addCamera({-1.0, -0.6, 0}, {0, 0.5, 0});
  boxes.addCamera({1.0, -0.6, 0}, {0, 0.5, 0});
  const SurfaceTextures textures = boxes.texture();
  const PartTexture& part = textures.parts.front();
  const std::size_t faces_of_wall = 6U * 20U * 20U * 2U;
  int front_faces = 0;
  for (std::size_t face = 0; face < faces_of_wall; ++face) {
    const Eigen::Vector3d middle = pointOf(boxes.scene.surface, face, kPlaces[0]);
    if (std::abs(middle.y() - 0.5) > 1e-4) continue;
    ++front_faces;
    for (const Eigen::Vector3d& weights : kPlaces) {
      const Eigen::Vector3d own = textureColor(part.image, placeOf(part.textures[face], weights));
      EXPECT_LT(own[2], 60) << "red of the block at " << middle.transpose();
    }
  }
  EXPECT_EQ(front_faces, 800);
}

/// The mean difference of the colours of two charts at their seams, on the side at y = 0.5.
double differenceAtSeams(const TextureSurface& surface, const PartTexture& part) {
  std::map<std::uint32_t, std::vector<Eigen::Vector3d>> by_vertex;
  std::set<std::pair<std::uint32_t, std::pair<float, float>>> seen;
  for (std::size_t face = 0; face < part.textures.size(); ++face) {
    if (std::abs(pointOf(surface, face, kPlaces[0]).y() - 0.5) > 1e-4) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector2f& place = part.textures[face][i];
      const std::uint32_t vertex = surface.faces[face][i];
      if (seen.insert({vertex, {place.x(), place.y()}}).second)
        by_vertex[vertex].push_back(textureColor(part.image, place));
    }
  }
  double sum = 0;
  int count = 0;
  for (const auto& [vertex, colors] : by_vertex) {
    for (std::size_t i = 1; i < colors.size(); ++i, ++count) sum += (colors[i] - colors[0]).cwiseAbs().mean();
  }
  return count == 0 ? 0 : sum / count;
}

// A plate seen by a bright and a dark image, half each.
TEST(TextureSurface, LevelsSeamsBetweenBrightAndDarkImages) {
  TexturedBoxes boxes;
  boxes.addBox({{-0.7, 0.5, -0.3}, {0.7, 0.6, 0.3}}, 24);
  boxes.colors = [](std::size_t, const Eigen::Vector3d& place) {
    return Eigen::Vector3d(Eigen::Vector3d::Constant(120) +
                           (colorOfPlace(place) - Eigen::Vector3d::Constant(128)) / 4);
  };
  boxes.addCamera({-0.35, -0.4, 0}, {-0.35, 1, 0}, 1.15);
  boxes.addCamera({0.35, -0.4, 0}, {0.35, 1, 0}, 0.85);
  const SurfaceTextures textures = boxes.texture();
  const double leveled = differenceAtSeams(boxes.scene.surface, textures.parts.front());
  // Without levelling the images differ by 30 % of about 120 levels.
  EXPECT_GT(0.3 * 120, 10 * leveled);
  EXPECT_GT(leveled, 0) << "there is a seam";
}

TEST(TextureSurface, ShowsLargePatches) {
  TexturedBoxes boxes = boxInARing();
  const FaceNeighbors neighbors = neighborsOf(boxes.scene.surface.faces);
  ViewRatings ratings(boxes.scene.surface);
  for (std::size_t view = 0; view < boxes.scene.views.size(); ++view)
    ratings.add(static_cast<ViewNumber>(view), boxes.scene.views[view], boxes.imageOf(view));
  const ViewedSurface viewed{boxes.scene.surface, boxes.scene.views, neighbors,
                             chooseFaceViews(ratings, neighbors)};
  std::vector<std::uint32_t> faces(boxes.scene.surface.faces.size());
  for (std::uint32_t face = 0; face < faces.size(); ++face) faces[face] = face;
  const TextureCharts cut = cutCharts(viewed, faces);
  // Sides do not share vertices in this mesh: four sides and the upper one, which may have some patches.
  EXPECT_GE(cut.charts.size(), 5U);
  EXPECT_LE(cut.charts.size(), 16U);
}

TEST(TextureSurface, SkipsImagesThatCannotBeRead) {
  TexturedBoxes boxes = boxInARing();
  TexturePart all;
  for (std::uint32_t face = 0; face < boxes.scene.surface.faces.size(); ++face) all.faces.push_back(face);
  boxes.scene.image = [&](std::size_t view) -> Result<cv::Mat> {
    return view == 2 ? Result<cv::Mat>(fail("frame 2 is damaged.")) : boxes.imageOf(view);
  };
  const auto textures = textureSurface(boxes.scene, std::span(&all, 1));
  ASSERT_TRUE(textures);
  EXPECT_EQ(textures->unused_views, std::vector<std::size_t>{2});
  boxes.scene.image = [](std::size_t view) -> Result<cv::Mat> {
    return fail("frame " + std::to_string(view) + " is damaged.");
  };
  const auto none = textureSurface(boxes.scene, std::span(&all, 1));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().what, "frame 0 is damaged.");
}

TEST(TextureSurface, Stops_WhenCancelled) {
  TexturedBoxes boxes = boxInARing();
  TexturePart all;
  for (std::uint32_t face = 0; face < boxes.scene.surface.faces.size(); ++face) all.faces.push_back(face);
  boxes.scene.image = [&](std::size_t view) -> Result<cv::Mat> { return boxes.imageOf(view); };
  int last = -1;
  const auto stopped = textureSurface(boxes.scene, std::span(&all, 1), [&](int done, const std::string&) {
    EXPECT_EQ(done, ++last);
    return done == 6 ? Result<void>(fail("cancelled")) : Result<void>();
  });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(last, 6);
  last = -1;
  ASSERT_TRUE(textureSurface(boxes.scene, std::span(&all, 1), [&](int done, const std::string&) {
    EXPECT_EQ(done, ++last);
    return Result<void>();
  }));
  EXPECT_EQ(last + 1, texturingSteps(4));
}

TEST(TextureSurface, GivesPartsTheirOwnImages) {
  TexturedBoxes boxes = boxInARing();
  std::vector<TexturePart> parts(3);
  for (std::uint32_t face = 0; face < boxes.scene.surface.faces.size(); ++face) {
    parts[0].faces.push_back(face);
    if (face % 5 == 0) parts[1].faces.push_back(face);
  }
  boxes.scene.image = [&](std::size_t view) -> Result<cv::Mat> { return boxes.imageOf(view); };
  const auto textures = textureSurface(boxes.scene, parts);
  ASSERT_TRUE(textures);
  ASSERT_EQ(textures->parts.size(), 3U);
  EXPECT_TRUE(textures->parts[2].textures.empty());
  for (std::size_t i = 0; i < parts[1].faces.size(); ++i) {
    const std::uint32_t face = parts[1].faces[i];
    const auto colorIn = [&](std::size_t part, std::size_t number) {
      const PartTexture& own = textures->parts[part];
      return textureColor(own.image, placeOf(own.textures[number], kPlaces[0]));
    };
    EXPECT_LT((colorIn(0, face) - colorIn(1, i)).cwiseAbs().maxCoeff(), 3) << face;
  }
}

}  // namespace
}  // namespace scantrove::test
