#include "core/labeling/fragment_contacts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "core/geometry/surface_step.h"
#include "tests/unit/labeling/painted_frame.h"

namespace scantrove {
namespace {

using test::PaintedFrame;
constexpr FragmentId kLeftPart{4}, kRightPart{2};
constexpr int kBorder_px = PaintedFrame::kHeight;  // the middle column, top to bottom

/// Makes the left and right halves one fragment and one segment each.
PaintedFrame withTwoParts(PaintedFrame frame) {
  PaintedFrame::fill(frame.view.fragments, PaintedFrame::kLeft, kLeftPart);
  PaintedFrame::fill(frame.view.fragments, PaintedFrame::kRight, kRightPart);
  frame.segments = frame.segmentsOf({PaintedFrame::kLeft, PaintedFrame::kRight});
  return frame;
}

std::vector<FragmentContact> contactsOf(const PaintedFrame& frame) {
  return findContacts(frame.input(), frame.view.fragments);
}

TEST(FragmentContacts, FoldHasTheAngleBetweenItsPlanes) {
  for (const float turn : {0.2F, 0.7F, std::numbers::pi_v<float> / 2}) {
    const auto contacts = contactsOf(withTwoParts(PaintedFrame::corner(turn)));
    ASSERT_EQ(contacts.size(), 1U);
    const FragmentContact& fold = contacts.front();
    EXPECT_EQ(std::pair(fold.a, fold.b), std::pair(kRightPart, kLeftPart)) << "the lower number first";
    EXPECT_EQ(fold.length_px, kBorder_px);
    EXPECT_EQ(fold.bends, kBorder_px);
    EXPECT_NEAR(fold.concavity_rad, turn, 1e-4F);
    EXPECT_EQ(fold.folded, turn > kClearBend_rad ? 1 : 0);
    EXPECT_EQ(fold.ridged, 0);
  }
}

TEST(FragmentContacts, RidgeHasANegativeAngle) {
  const auto contacts = contactsOf(withTwoParts(PaintedFrame::corner(-0.6F)));
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_NEAR(contacts.front().concavity_rad, -0.6F, 1e-4F);
  EXPECT_EQ(contacts.front().ridged, 1);
  EXPECT_EQ(contacts.front().folded, 0);
}

TEST(FragmentContacts, SmoothBorderHasNoBendAndALengthInMetres) {
  const auto contacts = contactsOf(withTwoParts(PaintedFrame::corner(0)));
  ASSERT_EQ(contacts.size(), 1U);
  const FragmentContact& smooth = contacts.front();
  EXPECT_NEAR(smooth.concavity_rad, 0, 1e-4F);
  EXPECT_EQ(smooth.folded + smooth.ridged, 0);
  // 48 pixels of 1 / 60 m, one metre away.
  EXPECT_NEAR(smooth.length_m, 0.8F, 1e-4F);
  EXPECT_NEAR(smooth.depth_m, 1, 1e-5F);
  EXPECT_FALSE(smooth.color_shift);
}

TEST(FragmentContacts, ColorShiftComparesMeans) {
  PaintedFrame frame = withTwoParts(PaintedFrame::corner(0));
  frame.color_lab.resize(PaintedFrame::kPixels);
  // Stripes of +-10 cancel out; the means differ by (3, 0, 4).
  for (int y = 0; y < PaintedFrame::kHeight; ++y) {
    const float stripe = y % 2 == 0 ? 10.0F : -10.0F;
    const int last = PaintedFrame::kWidth - 1, middle = PaintedFrame::kWidth / 2;
    PaintedFrame::fill(frame.color_lab, {0, y, middle - 1, y}, Eigen::Vector3f(50 + stripe, 0, 0));
    PaintedFrame::fill(frame.color_lab, {middle, y, last, y}, Eigen::Vector3f(53 - stripe, 0, 4));
  }
  const auto contacts = contactsOf(frame);
  ASSERT_EQ(contacts.size(), 1U);
  ASSERT_TRUE(contacts.front().color_shift);
  EXPECT_NEAR(*contacts.front().color_shift, 5, 1e-4F);
}

TEST(FragmentContacts, ColorShiftIsEqual_OnBothSidesOfAFragment) {
  PaintedFrame frame = withTwoParts(PaintedFrame::corner(0));
  const test::Rectangle island{44, 10, 57, 40};
  PaintedFrame::fill(frame.view.fragments, island, FragmentId{9});
  frame.color_lab.assign(PaintedFrame::kPixels, Eigen::Vector3f(50, 0, 0));
  PaintedFrame::fill(frame.color_lab, island, Eigen::Vector3f(56, 8, 0));
  const auto contacts = contactsOf(frame);
  ASSERT_EQ(contacts.size(), 2U);
  EXPECT_EQ(std::pair(contacts[1].a, contacts[1].b), std::pair(kRightPart, FragmentId{9}));
  EXPECT_NEAR(*contacts[0].color_shift, 0, 1e-4F);
  EXPECT_NEAR(*contacts[1].color_shift, 10, 1e-4F);
}

TEST(FragmentContacts, StepIsTheDistanceBetweenBothSurfaces) {
  for (const float step_m : {0.0F, 0.01F, 0.02F}) {
    const auto contacts = contactsOf(withTwoParts(PaintedFrame::step(step_m)));
    ASSERT_EQ(contacts.size(), 1U);
    EXPECT_NEAR(contacts.front().step_m, step_m, 1e-4F);
  }
  PaintedFrame frame = withTwoParts(PaintedFrame::step(0.02F));
  frame.view.normals_world.assign(PaintedFrame::kPixels, {0, 0, 0, 0});
  EXPECT_EQ(contactsOf(frame).front().step_m, 0) << "the direction is unknown";
}

TEST(FragmentContacts, ColorsCompareCompleteFragments) {
  PaintedFrame frame = withTwoParts(PaintedFrame::corner(0));
  // Equal colours at the border, different ones elsewhere.
  frame.color_lab.assign(PaintedFrame::kPixels, Eigen::Vector3f(50, 0, 0));
  PaintedFrame::fill(frame.color_lab, {48, 0, PaintedFrame::kWidth - 1, PaintedFrame::kHeight - 1},
                     Eigen::Vector3f(50, 40, 0));
  const FragmentContact contact = contactsOf(frame).front();
  EXPECT_NEAR(*contact.color_shift, 0, 1e-4F);
  ASSERT_TRUE(contact.colors);
  EXPECT_NEAR(contact.colors->chroma_difference, 20, 1e-3F);
}

TEST(FragmentContacts, FragmentsDoNotTouch_AcrossAnOcclusionEdge) {
  // At 1 m, d_max is the width of three pixels: 3 / 60 m.
  EXPECT_EQ(contactsOf(withTwoParts(PaintedFrame::step(0.03F))).size(), 1U);
  EXPECT_THAT(contactsOf(withTwoParts(PaintedFrame::step(0.06F))), testing::IsEmpty());
}

TEST(FragmentContacts, GapIsBridged_UpToTwoPixels) {
  for (const int gap : {1, 2, 3}) {
    PaintedFrame frame = withTwoParts(PaintedFrame::corner(0));
    const int first = PaintedFrame::kWidth / 2;
    PaintedFrame::fill(frame.view.fragments, {first, 0, first + gap - 1, PaintedFrame::kHeight - 1},
                       FragmentId{});
    const auto contacts = contactsOf(frame);
    EXPECT_EQ(contacts.empty() ? 0 : contacts.front().length_px, gap > 2 ? 0 : kBorder_px) << gap;
  }
}

TEST(FragmentContacts, BorderIsBridged_WhenOneSegmentLiesOnBothSides) {
  PaintedFrame frame = withTwoParts(PaintedFrame::corner(0));
  EXPECT_EQ(contactsOf(frame).front().bridged_px, 0);
  // A segment over the border in its upper quarter.
  const test::Rectangle bridge{20, 0, 50, PaintedFrame::kHeight / 4 - 1};
  frame.segments = frame.segmentsOf({PaintedFrame::kLeft, PaintedFrame::kRight, bridge});
  EXPECT_EQ(contactsOf(frame).front().bridged_px, kBorder_px / 4);
  // Borders of segments and voxels are ragged by a pixel or two; a segment that narrow is no bridge.
  const int middle = PaintedFrame::kWidth / 2;
  const test::Rectangle narrow{middle - 2, 0, middle + 1, PaintedFrame::kHeight - 1};
  frame.segments = frame.segmentsOf({PaintedFrame::kLeft, PaintedFrame::kRight, narrow});
  EXPECT_EQ(contactsOf(frame).front().bridged_px, 0);
}

TEST(FragmentContacts, FragmentsTouch_WithoutNormals) {
  PaintedFrame frame = withTwoParts(PaintedFrame::corner(0.8F));
  PaintedFrame::fill(frame.view.normals_world, PaintedFrame::kRight, Eigen::Vector4f(0, 0, 0, 0));
  const auto contacts = contactsOf(frame);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts.front().length_px, kBorder_px);
  EXPECT_EQ(contacts.front().bends, 0);
  EXPECT_EQ(contacts.front().concavity_rad, 0);
}

TEST(FragmentContacts, ContactsAreEmpty_WithoutSurface) {
  PaintedFrame frame = withTwoParts(PaintedFrame::corner(0));
  PaintedFrame::fill(frame.view.vertices_world, PaintedFrame::kRight, Eigen::Vector4f(0, 0, 0, 0));
  EXPECT_THAT(contactsOf(frame), testing::IsEmpty());
}

TEST(FragmentContacts, ContactsAreOrderedByFragments) {
  PaintedFrame frame = withTwoParts(PaintedFrame::corner(0));
  PaintedFrame::fill(frame.view.fragments, {16, 12, 47, 35}, FragmentId{9});
  PaintedFrame::fill(frame.view.fragments, {30, 20, 33, 24}, FragmentId{1});
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const FragmentContact& contact : contactsOf(frame))
    pairs.emplace_back(contact.a.value, contact.b.value);
  EXPECT_THAT(pairs,
              testing::ElementsAre(std::pair(1, 9), std::pair(2, 4), std::pair(2, 9), std::pair(4, 9)));
}

}  // namespace
}  // namespace scantrove
