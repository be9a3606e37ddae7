#include "core/session/unknown_colors.h"

#include <gtest/gtest.h>

namespace scantrove::test {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

/// A strip of triangles: 0, 1, 2; 1, 2, 3; 2, 3, 4; ...
LabeledMesh stripOf(std::uint32_t vertices) {
  LabeledMesh strip;
  strip.vertices.resize(vertices);
  for (std::uint32_t i = 0; i + 2 < vertices; ++i) strip.faces.push_back({i, i + 1, i + 2});
  return strip;
}

TEST(UnknownColors, AreThoseOfTheSurfaceAround) {
  LabeledMesh strip = stripOf(6);
  strip.vertices[0].rgb = {200, 100, 0};
  strip.vertices[1].rgb = {100, 200, 0};
  fillUnknownColors(strip, {true, true, false, false, false, false});
  // Vertex 2 has the mean of 0 and 1, and of 1 again in the second face.
  EXPECT_EQ(strip.vertices[2].rgb, (Rgb{133, 167, 0}));
  for (std::size_t i = 3; i < 6; ++i) {
    EXPECT_GE(strip.vertices[i].rgb[0], 100);
    EXPECT_GE(strip.vertices[i].rgb[1], 160);
  }
  EXPECT_EQ(strip.vertices[0].rgb, (Rgb{200, 100, 0}));
  EXPECT_EQ(strip.vertices[1].rgb, (Rgb{100, 200, 0}));
}

TEST(UnknownColors, AreGrey_WhenNoneIsNear) {
  LabeledMesh strip = stripOf(1000);
  strip.vertices[0].rgb = {200, 100, 0};
  strip.vertices.emplace_back();  // of no face
  std::vector<bool> is_known(strip.vertices.size());
  is_known[0] = true;
  fillUnknownColors(strip, is_known);
  EXPECT_EQ(strip.vertices[10].rgb, (Rgb{200, 100, 0}));
  EXPECT_EQ(strip.vertices[999].rgb, (Rgb{128, 128, 128}));
  EXPECT_EQ(strip.vertices[1000].rgb, (Rgb{128, 128, 128}));
}

TEST(UnknownColors, BlackIsAColor) {
  LabeledMesh strip = stripOf(3);
  strip.vertices[2].rgb = {90, 90, 90};
  fillUnknownColors(strip, {true, true, true});
  EXPECT_EQ(strip.vertices[0].rgb, (Rgb{0, 0, 0}));
}

TEST(UnknownColors, Stay_WhenTheMeshHasNone) {
  LabeledMesh strip = stripOf(4);
  fillUnknownColors(strip, std::vector<bool>(4));
  EXPECT_EQ(strip.vertices[3].rgb, (Rgb{0, 0, 0}));
}

}  // namespace
}  // namespace scantrove::test
