#include "core/session/key_frame_choice.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

Eigen::Isometry3d at(double x_m, double turned_deg = 0) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().x() = x_m;
  pose.linear() = Eigen::AngleAxisd(turned_deg * 3.14159265 / 180, Eigen::Vector3d::UnitY()).matrix();
  return pose;
}

TEST(KeyFrameChoice, TakesAPose_WhenFarFromAllTakenPoses) {
  KeyFrameChoice choice;
  EXPECT_TRUE(choice.takes(at(0)));
  EXPECT_FALSE(choice.takes(at(0.07, 4.5)));
  EXPECT_TRUE(choice.takes(at(0.08))) << "7.5 cm";
  EXPECT_TRUE(choice.takes(at(0, 5.5))) << "5 degrees";
  EXPECT_FALSE(choice.takes(at(0.01))) << "back where it was";
}

TEST(KeyFrameChoice, SelectsNothing_WhenAskedOnlyWhatIsNew) {
  KeyFrameChoice choice;
  EXPECT_TRUE(choice.isNew(at(0)));
  EXPECT_TRUE(choice.isNew(at(0)));
  EXPECT_TRUE(choice.takes(at(0)));
  EXPECT_FALSE(choice.isNew(at(0.05)));
}

TEST(KeyFrameChoice, ContinuesFromTheKeyFramesOfASession) {
  KeyFrameChoice choice({at(1)});
  EXPECT_FALSE(choice.takes(at(1.02)));
  EXPECT_TRUE(choice.takes(at(0)));
}

}  // namespace
}  // namespace scantrove
