#include "core/session/session_setup.h"

#include <gmock/gmock.h>

#include <string>

namespace scantrove::test {
namespace {

Result<SessionSetup> setupOf(const std::string& camera) { return setupFrom({{"camera", camera}}); }

TEST(SessionSetup, IsRead_WhenTheCameraIsPlausible) {
  const auto setup = setupOf(R"({"K": [525, 525, 319.5, 239.5], "size": [640, 480]})");
  ASSERT_TRUE(setup) << setup.error().message();
  EXPECT_EQ(setup->K.width, 640);
}

TEST(SessionSetup, KeepsOriginAndUseOfPoses) {
  SessionSetup setup;
  setup.source = "walk";
  setup.K = {525, 525, 319.5F, 239.5F, 640, 480};
  setup.origin_m = {500000, -4, 12};
  setup.poses = "tracked";
  const auto back = setupFrom(metadataOf(setup));
  ASSERT_TRUE(back) << back.error().message();
  EXPECT_EQ(back->origin_m, setup.origin_m);
  EXPECT_EQ(back->poses, "tracked");
  SessionMetadata older = metadataOf(setup);
  older.erase(kPosesKey);
  EXPECT_EQ(setupFrom(older)->poses, "");
}

TEST(SessionSetup, Fails_WhenTheCameraIsImplausible) {
  for (const char* camera : {R"({"K": [1e-30, 1e-30, 319.5, 239.5], "size": [640, 480]})",
                             R"({"K": [525, 1e30, 319.5, 239.5], "size": [640, 480]})",
                             R"({"K": [525, 525, 1e9, 239.5], "size": [640, 480]})",
                             R"({"K": [525, 525, 319.5, 239.5], "size": [640, 0]})",
                             R"({"K": [525, 525, 319.5, 239.5], "size": [-640, 480]})"}) {
    const auto setup = setupOf(camera);
    ASSERT_FALSE(setup) << camera;
    EXPECT_THAT(setup.error().message(), testing::HasSubstr("no camera can have"));
  }
}

}  // namespace
}  // namespace scantrove::test
