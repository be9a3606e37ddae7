#include <gtest/gtest.h>

#include <QLabel>
#include <algorithm>

#include "ui/panels/status_strip.h"

namespace scantrove {
namespace {

TEST(StatusStrip, ShowsTheTrackingState) {
  StatusStrip strip;
  strip.showState(ScanState::scanning);
  ScanSnapshot snapshot;
  snapshot.frame_index = 0;
  snapshot.pose.state = TrackingState::tracking;
  strip.showSnapshot(snapshot);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Tracking"));
  snapshot.pose.state = TrackingState::lost;
  strip.showSnapshot(snapshot);
  EXPECT_TRUE(strip.stateText().startsWith(QStringLiteral("Lost")));
  strip.showState(ScanState::finished);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Finished"));
}

TEST(StatusStrip, ShowsThePreparation_UntilTheFirstFrame) {
  StatusStrip strip;
  strip.showState(ScanState::starting);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Starting…"));
  strip.showPreparing();
  EXPECT_TRUE(strip.stateText().startsWith(QStringLiteral("Preparing the OpenCL device")));
  strip.showState(ScanState::scanning);
  EXPECT_TRUE(strip.stateText().startsWith(QStringLiteral("Preparing the OpenCL device")));
  ScanSnapshot snapshot;
  snapshot.frame_index = 0;
  snapshot.pose.state = TrackingState::tracking;
  strip.showSnapshot(snapshot);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Tracking"));
  strip.showState(ScanState::starting);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Starting…"));
}

TEST(StatusStrip, ShowsTheProgressOfTheRefinement) {
  StatusStrip strip;
  strip.showState(ScanState::scanning);
  strip.showState(ScanState::finishing);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Finishing…")) << "the recording has ended by itself";
  strip.showState(ScanState::refining);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Refining objects"));
  strip.showRefinement(12, 40);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Refining objects: key frame 12 of 40"));
  strip.showState(ScanState::finished);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Finished"));
  strip.showState(ScanState::starting);
  strip.showState(ScanState::refining);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Refining objects")) << "no progress of the previous scan";
}

TEST(StatusStrip, ShowsNoSpeed_AfterTheLastFrame) {
  StatusStrip strip;
  strip.showState(ScanState::scanning);
  ScanSnapshot snapshot;
  snapshot.frame_index = 0;
  snapshot.fps = 8.5;
  snapshot.stage_times = {{"raycast", 50}};
  strip.showSnapshot(snapshot);
  const auto showsSpeed = [&strip] {
    return std::ranges::any_of(strip.findChildren<QLabel*>(), [](const QLabel* label) {
      return label->text().contains(QStringLiteral("fps")) || label->text().contains(QStringLiteral("ms"));
    });
  };
  EXPECT_TRUE(showsSpeed());
  strip.showState(ScanState::finishing);
  EXPECT_FALSE(showsSpeed());
  strip.showSnapshot(snapshot);
  EXPECT_FALSE(showsSpeed()) << "the last snapshot comes after the last frame";
  strip.showState(ScanState::refining);
  strip.showSnapshot(snapshot);
  EXPECT_FALSE(showsSpeed());
}

TEST(StatusStrip, ShowsNoSpeed_WithoutStageTimes) {
  StatusStrip strip;
  ScanSnapshot snapshot;
  snapshot.frame_index = 0;
  snapshot.fps = 20;
  snapshot.stage_times = {{"track", 5}};
  const auto shows = [&](const QString& text) {
    return std::ranges::any_of(strip.findChildren<QLabel*>(),
                               [&](const QLabel* label) { return label->text().contains(text); });
  };
  strip.showSnapshot(snapshot);
  EXPECT_TRUE(shows(QStringLiteral("20.0 fps")));
  snapshot.stage_times.clear();
  snapshot.fps = 0;
  strip.showSnapshot(snapshot);
  EXPECT_FALSE(shows(QStringLiteral("fps")));
  EXPECT_FALSE(shows(QStringLiteral("ms a frame")));
}

}  // namespace
}  // namespace scantrove
