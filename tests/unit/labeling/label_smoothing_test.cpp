#include "core/labeling/label_smoothing.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/unit/labeling/painted_frame.h"

namespace scantrove {
namespace {

using test::PaintedFrame;
using test::Rectangle;

constexpr FragmentId kMostFragment{1}, kOddFragment{2}, kOtherFragment{3};
constexpr int kSpeck_u = 20, kSpeck_v = 18;
constexpr Rectangle kOnePixel{kSpeck_u, kSpeck_v, kSpeck_u, kSpeck_v};

std::size_t wallPixel(int u, int v) { return static_cast<std::size_t>(v * PaintedFrame::kWidth + u); }

/// An image of one fragment with a rectangle of another one.
std::vector<FragmentId> painted(const Rectangle& where, FragmentId fragment,
                                FragmentId around = kMostFragment) {
  std::vector<FragmentId> fragments(PaintedFrame::kPixels, around);
  PaintedFrame::fill(fragments, where, fragment);
  return fragments;
}

std::vector<FragmentId> smoothed(std::vector<FragmentId> fragments,
                                 const RenderedView& view = PaintedFrame::corner(0).view) {
  removeIsolatedLabels(view, fragments);
  return fragments;
}

TEST(RemoveIsolatedLabels, OddPixelTakesTheMajority) {
  const std::vector<FragmentId> expected(PaintedFrame::kPixels, kMostFragment);
  EXPECT_EQ(smoothed(painted(kOnePixel, kOddFragment)), expected);
  EXPECT_EQ(smoothed(painted({kSpeck_u, kSpeck_v, kSpeck_u + 1, kSpeck_v}, kOddFragment)), expected)
      << "two pixels";
}

TEST(RemoveIsolatedLabels, OddPixelTakesTheMoreFrequentNeighbor) {
  // Three neighbours to the right are of one fragment, the other five of the wall.
  std::vector<FragmentId> fragments =
      painted({kSpeck_u + 1, 0, PaintedFrame::kWidth - 1, PaintedFrame::kHeight - 1}, kOtherFragment);
  fragments[wallPixel(kSpeck_u, kSpeck_v)] = kOddFragment;
  EXPECT_EQ(smoothed(fragments)[wallPixel(kSpeck_u, kSpeck_v)], kMostFragment);
}

TEST(RemoveIsolatedLabels, LineOfTwoPixelsStays) {
  const Rectangle upright{kSpeck_u, 0, kSpeck_u + 1, PaintedFrame::kHeight - 1},
      level{0, kSpeck_v, PaintedFrame::kWidth - 1, kSpeck_v + 1};
  for (const Rectangle& line : {upright, level}) {
    const std::vector<FragmentId> fragments = painted(line, kOddFragment);
    EXPECT_EQ(smoothed(fragments), fragments);
  }
}

TEST(RemoveIsolatedLabels, SquareOfTwoPixelsStays) {
  const std::vector<FragmentId> fragments =
      painted({kSpeck_u, kSpeck_v, kSpeck_u + 1, kSpeck_v + 1}, kOddFragment);
  EXPECT_EQ(smoothed(fragments), fragments);
}

TEST(RemoveIsolatedLabels, PixelKeepsItsFragment_AcrossADepthStep) {
  RenderedView view = PaintedFrame::corner(0).view;
  const std::vector<FragmentId> fragments = painted(kOnePixel, kOddFragment);
  ASSERT_NE(smoothed(fragments, view), fragments) << "without a step";
  for (const float z_m : {0.8F, 1.5F}) {
    view.vertices_world[wallPixel(kSpeck_u, kSpeck_v)] =
        view.K.backProject(kSpeck_u, kSpeck_v, z_m).homogeneous();
    EXPECT_EQ(smoothed(fragments, view), fragments) << z_m;
  }
}

TEST(RemoveIsolatedLabels, PixelTakesTheFragmentOfItsSideOfAStep) {
  // The right wall is 0.5 m farther away. An odd pixel at its edge has five neighbours there.
  const PaintedFrame frame = PaintedFrame::step(0.5F);
  std::vector<FragmentId> fragments = painted(PaintedFrame::kRight, kOtherFragment);
  const std::size_t at_edge = wallPixel(PaintedFrame::kWidth / 2, kSpeck_v);
  fragments[at_edge] = kOddFragment;
  EXPECT_EQ(smoothed(fragments, frame.view)[at_edge], kOtherFragment);
  // Two of them are unlabelled: the three that remain, and three of the left wall, are no majority.
  fragments[at_edge + 1] = fragments[wallPixel(PaintedFrame::kWidth / 2, kSpeck_v + 1)] = FragmentId{};
  EXPECT_EQ(smoothed(fragments, frame.view)[at_edge], kOddFragment);
}

TEST(RemoveIsolatedLabels, UnlabeledPixelsStay) {
  const std::vector<FragmentId> hole = painted(kOnePixel, FragmentId{});
  const std::vector<FragmentId> island = painted(kOnePixel, kOddFragment, FragmentId{});
  EXPECT_EQ(smoothed(hole), hole);
  EXPECT_EQ(smoothed(island), island) << "no neighbour has a fragment";
}

constexpr int kPictureWidth = 6;

/// Regions by letter, in rows of kPictureWidth; '.': none.
std::vector<RegionId> pictureOf(const std::string& letters) {
  std::vector<RegionId> regions;
  for (const char letter : letters)
    regions.push_back(letter == '.' ? RegionId{} : RegionId{static_cast<std::uint32_t>(letter)});
  return regions;
}

std::vector<RegionId> withoutIsolated(const std::string& letters) {
  std::vector<RegionId> regions = pictureOf(letters);
  removeIsolatedLabels(kPictureWidth, regions);
  return regions;
}

TEST(RemoveIsolatedLabelsOfAPicture, OddPixelTakesTheMostFrequentNeighbor) {
  EXPECT_EQ(withoutIsolated("aaabbb"
                            "aacbbb"
                            "aaabbb"),
            pictureOf("aaabbb"
                      "aaabbb"
                      "aaabbb"))
      << "five neighbours against three";
  EXPECT_EQ(withoutIsolated("......"
                            "..a..."
                            "......"),
            pictureOf(std::string(18, '.')));
}

TEST(RemoveIsolatedLabelsOfAPicture, PixelsAtTheBorderHaveFewerNeighbors) {
  EXPECT_EQ(withoutIsolated("baaaaa"
                            "aaaaaa"
                            "aaaaab"),
            pictureOf(std::string(18, 'a')));
  const std::string corner =
      "bbaaaa"
      "bbaaaa"
      "aaaaaa"
      "aaaaaa";
  EXPECT_EQ(withoutIsolated(corner), pictureOf(corner));
}

TEST(RemoveIsolatedLabelsOfAPicture, LineOfTwoPixelsAndUnlabeledPixelsStay) {
  for (const std::string kept : {"aabbaa"
                                 "aabbaa"
                                 "aabbaa",
                                 "aaaaaa"
                                 "aa.aaa"
                                 "aaaaaa"})
    EXPECT_EQ(withoutIsolated(kept), pictureOf(kept));
}

}  // namespace
}  // namespace scantrove
