#include "core/dataset/frame_choice.h"

#include <gmock/gmock.h>

#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

using testing::ElementsAre;

/// Five frames: 0, 20 and 40 are key frames. 0 is checked, 20 left out, 30 checked; the others are open.
class ReviewedScene : public SmallScene {
 public:
  ReviewedScene() { frames = 5; }
  [[nodiscard]] Result<std::vector<KeyFrameInfo>> keyFrames(bool all_frames) override {
    auto infos = SmallScene::keyFrames(all_frames);
    for (KeyFrameInfo& info : *infos) {
      if (info.index == 0 || info.index == 30) info.review = ReviewState::checked;
      if (info.index == 20) info.review = ReviewState::left_out;
    }
    return infos;
  }
};

std::vector<int> indicesOf(const FrameChoice& choice) {
  std::vector<int> indices;
  for (const KeyFrameInfo& frame : choice.frames) indices.push_back(frame.index);
  return indices;
}

TEST(FrameChoice, OmitsFramesThatWereLeftOut) {
  ReviewedScene scene;
  const auto choice = chooseFrames(scene, {});
  ASSERT_TRUE(choice);
  EXPECT_THAT(indicesOf(*choice), ElementsAre(0, 40));
  EXPECT_EQ(choice->missing(), "1 frame is left out in review.");
}

TEST(FrameChoice, OmitsThemAmongAllFrames) {
  ReviewedScene scene;
  ExportOptions options;
  options.all_frames = true;
  const auto choice = chooseFrames(scene, options);
  ASSERT_TRUE(choice);
  EXPECT_THAT(indicesOf(*choice), ElementsAre(0, 10, 30, 40));
}

TEST(FrameChoice, HasAllCheckedFrames_WithCheckedOnly) {
  ReviewedScene scene;
  ExportOptions options;
  options.checked_only = true;
  const auto choice = chooseFrames(scene, options);
  ASSERT_TRUE(choice);
  EXPECT_THAT(indicesOf(*choice), ElementsAre(0, 30));
  EXPECT_EQ(choice->unchecked, 2);
  EXPECT_EQ(choice->left_out, 1);
}

TEST(FrameChoice, PreviewsTheSameFrames) {
  ReviewedScene scene;
  ExportOptions options;
  options.format = DatasetFormat::masks;
  options.checked_only = true;
  const auto preview = previewExport(scene, options);
  ASSERT_TRUE(preview) << preview.error().message();
  EXPECT_EQ(preview->images, 2);
}

}  // namespace
}  // namespace scantrove::test
