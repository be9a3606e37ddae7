#include "core/labeling/small_fragment_pieces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "tests/reference/small_pieces_reference.h"

namespace scantrove {
namespace {

/// One digit per pixel; '.' is no fragment.
std::vector<FragmentId> imageOf(const std::vector<std::string>& rows) {
  std::vector<FragmentId> image;
  for (const std::string& row : rows) {
    for (const char c : row) image.push_back({c == '.' ? 0U : static_cast<std::uint32_t>(c - '0')});
  }
  return image;
}

TEST(SmallFragmentPieces, RemovesSmallPieces_WhenTheFragmentHasALargerOne) {
  EXPECT_EQ(withoutSmallPieces(imageOf({"1112222",  //
                                        "1121222",  //
                                        "1112221"}),
                               7, 3),
            imageOf({"1112222",  //
                     "11..222",  //
                     "111222."}));
}

TEST(SmallFragmentPieces, KeepsASmallPiece_WhenTheFragmentHasNoLargerOne) {
  const auto image = imageOf({"1111", "1231", "1111"});
  EXPECT_EQ(withoutSmallPieces(image, 4, 5), image);
}

TEST(SmallFragmentPieces, CornersDoNotConnect) {
  EXPECT_EQ(withoutSmallPieces(imageOf({".111222",  //
                                        "1211222"}),
                               7, 2),
            imageOf({".111222",  //
                     "..11222"}));
}

TEST(SmallFragmentPieces, KeepsAWindingPiece) {
  const auto image = imageOf({"1.111.1",  //
                              "1.1.1.1",  //
                              "111.111",  //
                              "2222222"});
  EXPECT_EQ(withoutSmallPieces(image, 7, 14), image) << "15 pixels whose rows connect only through others";
}

TEST(SmallFragmentPieces, EqualsTheDefinition_InRandomImages) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const int width = 1 + static_cast<int>(random() % 20), height = 1 + static_cast<int>(random() % 15);
    std::vector<FragmentId> image(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const auto kinds = 2 + static_cast<std::uint32_t>(random() % 3);
    for (FragmentId& fragment : image) fragment.value = static_cast<std::uint32_t>(random()) % kinds;
    const int least_px = static_cast<int>(random() % 12);
    ASSERT_EQ(withoutSmallPieces(image, width, least_px),
              reference::withoutSmallPieces(image, width, least_px))
        << trial;
  }
}

}  // namespace
}  // namespace scantrove
