#include "core/capture/color_presence.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

TEST(ColorPresence, ExpectsColor_UntilALongStretchHasNone) {
  ColorPresence color;
  EXPECT_FALSE(color.isExpected()) << "before the first frame";
  EXPECT_FALSE(color.add(false));
  EXPECT_FALSE(color.isExpected());
  EXPECT_TRUE(color.add(true)) << "the first one with colour";
  EXPECT_FALSE(color.add(true));
  for (int i = 0; i + 1 < ColorPresence::kLongestGap; ++i) EXPECT_FALSE(color.add(false));
  EXPECT_TRUE(color.isExpected());
  EXPECT_FALSE(color.add(false));
  EXPECT_FALSE(color.isExpected());
  EXPECT_TRUE(color.add(true));
}

}  // namespace
}  // namespace scantrove
