#include "core/scan/object_collector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QSqlDatabase>
#include <QSqlQuery>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/scan/candidate_crop.h"
#include "tests/support/qt_main_thread.h"
#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using testing::HasSubstr;

const Intrinsics kWorking{150, 150, 80, 60, 160, 120};
const Eigen::Vector3f kSize(0.2F, 0.15F, 0.1F);

/// A thing on a table as discovery finds it: of another look for each seed, at a place of its own.
struct Thing {
  int seed = 0;
  int place = 0;
  RegionId region;

  [[nodiscard]] cv::Rect box() const { return {5 + 50 * place, 30, 40, 50}; }
  [[nodiscard]] Eigen::Vector3f centroid() const { return {0.5F * static_cast<float>(place), 0, 1}; }
  [[nodiscard]] Candidate candidate() const {
    Candidate candidate;
    candidate.region = region;
    candidate.box_px = box();
    candidate.mask = cv::Mat(box().size(), CV_8UC1, cv::Scalar(0));
    cv::ellipse(candidate.mask, {20, 25}, {19, 24}, 0, 0, 360, 255, cv::FILLED);
    candidate.centroid_world = centroid();
    candidate.size_m = kSize;
    return candidate;
  }
  void paint(cv::Mat& color) const {
    cv::RNG random(static_cast<std::uint64_t>(seed) * 7919 + 1);
    cv::Mat patches(4, 4, CV_8UC3), picture;
    random.fill(patches, cv::RNG::UNIFORM, 20, 236);
    const cv::Rect in_color(2 * box().x, 2 * box().y, 2 * box().width, 2 * box().height);
    cv::resize(patches, picture, in_color.size(), 0, 0, cv::INTER_CUBIC);
    picture.copyTo(color(in_color));
  }
};

class ObjectCollectorTest : public testing::Test {
 protected:
  void SetUp() override {
    moveIn(compute_, ComputeContext::create({}));
    moveIn(database_, ObjectDatabase::open(file()));
    moveIn(person_, ObjectDatabase::open(file()));
    beginScan();
  }
  template <class T>
  static void moveIn(T& target, Result<T> result) {
    ASSERT_TRUE(result) << result.error().message();
    target = std::move(*result);
  }
  [[nodiscard]] std::string file() const { return (folder_ / "catalogue.sqlite").string(); }

  void beginScan() {
    std::int64_t session = 0;
    moveIn(session, database_->beginSession("table"));
    moveIn(collector_, ObjectCollector::create(*compute_, *database_, session, {}));
  }

  static SurfaceInColor inColor() {
    return locateInColor(std::nullopt, kWorking, Eigen::Isometry3d::Identity(), {});
  }

  /// One frame that shows `things` from a direction about the vertical.
  FrameObjects look(const std::vector<Thing>& things, double degrees = 0) {
    RgbdFrame frame;
    frame.index = frame_++;
    frame.color = cv::Mat(240, 320, CV_8UC3, cv::Scalar(40, 50, 60));
    frame.depth = cv::Mat(240, 320, CV_16UC1, cv::Scalar(1000));
    std::vector<Candidate> candidates;
    for (const Thing& thing : things) {
      thing.paint(frame.color);
      candidates.push_back(thing.candidate());
    }
    PoseEstimate pose;
    pose.state = TrackingState::tracking;
    const double angle = degrees * 3.14159265 / 180;
    pose.T_world_camera = Eigen::Translation3d(30 * std::sin(angle), 0, -30 * std::cos(angle));
    return collector_->collect(frame, pose, inColor(), candidates);
  }

  std::vector<ObjectRecord> objects() {
    const Result<std::vector<ObjectRecord>> objects = person_->objects();
    EXPECT_TRUE(objects);
    return objects.value_or(std::vector<ObjectRecord>());
  }

  test::QtMainThread qt_;
  test::TemporaryFolder folder_;
  std::unique_ptr<ComputeContext> compute_;
  std::unique_ptr<ObjectDatabase> database_;
  std::unique_ptr<ObjectDatabase> person_;  // the window, or another program
  std::unique_ptr<ObjectCollector> collector_;
  int frame_ = 0;

  const Thing mug_{1, 0, RegionId{11}};
  const Thing box_{2, 1, RegionId{12}};
  const Thing cup_{3, 2, RegionId{13}};
};

TEST_F(ObjectCollectorTest, AddsTheUnknownOnceAndKeepsNewDirections) {
  FrameObjects first = look({mug_, box_});
  ASSERT_EQ(first.added.size(), 2U);
  EXPECT_TRUE(first.recognised.empty());
  EXPECT_EQ(first.seen[0].object, first.added[0].id);
  EXPECT_EQ(first.seen[0].name, first.added[0].name);
  EXPECT_FALSE(first.seen[0].recognised);
  FrameObjects second = look({mug_, box_}, 10);
  EXPECT_TRUE(second.added.empty() && second.new_views.empty());
  EXPECT_EQ(look({mug_}, 25).new_views, std::vector<ObjectId>{first.added[0].id});
  EXPECT_TRUE(look({mug_}, 30).new_views.empty());
  EXPECT_EQ(objects().at(0).views, 2);
  EXPECT_EQ(collector_->record(first.added[0].id)->views, 2);
  EXPECT_EQ(collector_->objectOf(mug_.region), first.added[0].id);
  EXPECT_FALSE(collector_->objectOf(RegionId{99}));
}

TEST_F(ObjectCollectorTest, AnObjectHasSoManyViewsAndNoMore) {
  DetectionParams params;
  params.max_views = 3;
  collector_->setParams(params);
  for (int i = 0; i < 6; ++i) static_cast<void>(look({mug_}, 25 * i));
  EXPECT_EQ(objects().at(0).views, 3);
}

TEST_F(ObjectCollectorTest, RecognisesWhatAnEarlierScanAddedAndSaysSoOnce) {
  const ObjectId mug = look({mug_}).added.at(0).id;
  beginScan();
  const FrameObjects first = look({mug_, box_});
  ASSERT_EQ(first.recognised.size(), 1U);
  EXPECT_EQ(first.recognised[0].id, mug);
  EXPECT_TRUE(first.seen[0].recognised);
  EXPECT_EQ(first.added.size(), 1U);
  EXPECT_TRUE(look({mug_, box_}).recognised.empty());
  const auto met = collector_->metObjects();
  ASSERT_EQ(met.size(), 2U);
  EXPECT_EQ(met[0].recognised_from, "table");
  EXPECT_EQ(met[1].recognised_from, "");
}

TEST_F(ObjectCollectorTest, TheSameThingUnderANewRegionIsTheSameObject) {
  const ObjectId mug = look({mug_}).added.at(0).id;
  const Thing again{7, mug_.place, RegionId{77}};  // even when it looks like another
  EXPECT_TRUE(look({again}).added.empty());
  EXPECT_EQ(collector_->objectOf(again.region), mug);
}

TEST_F(ObjectCollectorTest, WhatAPersonDeletedIsNotAddedAgainAndComesBackWithUndo) {
  const ObjectId mug = look({mug_, box_}).added.at(0).id;
  ASSERT_TRUE(person_->remove(std::array{mug}));
  const Thing under_a_new_region{mug_.seed, mug_.place, RegionId{77}};
  for (int frame = 0; frame < 20; ++frame) {
    const FrameObjects seen = look({mug_, box_}, 25 * frame);
    EXPECT_TRUE(seen.added.empty() && seen.recognised.empty());
    EXPECT_FALSE(seen.seen[0].object);
    EXPECT_EQ(seen.seen[0].name, "");
    EXPECT_TRUE(look({under_a_new_region}, 25 * frame).added.empty());
  }
  EXPECT_EQ(objects().size(), 1U);
  EXPECT_EQ(collector_->metObjects().size(), 1U);
  ASSERT_TRUE(person_->restore(std::array{mug}));
  const FrameObjects restored = look({mug_});
  EXPECT_EQ(restored.seen[0].object, mug);
  EXPECT_TRUE(restored.added.empty());
  EXPECT_EQ(collector_->objectOf(under_a_new_region.region), mug);
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(ObjectCollectorTest, NamesAndConfirmationsOfAPersonAreSeenInTheNextFrame) {
  const ObjectId mug = look({mug_}).added.at(0).id;
  ASSERT_TRUE(person_->rename(mug, "my mug"));
  ASSERT_TRUE(person_->setConfirmed(std::array{mug}, true));
  const FrameObjects seen = look({mug_});
  EXPECT_EQ(seen.seen[0].name, "my mug");
  EXPECT_TRUE(seen.seen[0].confirmed);
}

TEST_F(ObjectCollectorTest, AMergeByAPersonIsFollowedAndSoIsItsUndo) {
  const FrameObjects first = look({mug_, box_});
  const ObjectId mug = first.added.at(0).id, box = first.added.at(1).id;
  const Result<ObjectMerge> merge = person_->merge(std::array{mug, box});
  ASSERT_TRUE(merge);
  FrameObjects seen = look({mug_, box_});
  EXPECT_EQ(seen.seen[0].object, merge->into);
  EXPECT_EQ(seen.seen[1].object, merge->into);
  EXPECT_EQ(collector_->metObjects().size(), 1U);
  // A view of the part that was merged in goes with it when the merge is taken back.
  EXPECT_EQ(look({mug_, box_}, 30).new_views.size(), 1U) << "the same direction of one object";
  ASSERT_TRUE(person_->unmerge(*merge));
  seen = look({mug_, box_}, 60);
  EXPECT_EQ(seen.seen[0].object, mug);
  EXPECT_EQ(seen.seen[1].object, box);
  EXPECT_EQ(collector_->metObjects().size(), 2U);
}

TEST_F(ObjectCollectorTest, RegionsThatJoinMakeOneObjectUnlessAPersonTookThatBack) {
  const FrameObjects first = look({mug_, box_});
  const ObjectId mug = first.added.at(0).id, box = first.added.at(1).id;
  collector_->regionsMerged(mug_.region, box_.region);
  const FrameObjects joined = look({mug_});
  ASSERT_EQ(joined.merged.size(), 1U);
  EXPECT_EQ(joined.merged[0].into, mug) << "the older of equals";
  EXPECT_EQ(joined.seen[0].object, mug);
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_EQ(objects()[0].views, 2);
  ASSERT_TRUE(person_->unmerge(joined.merged[0]));
  const Thing box_again{box_.seed, box_.place, RegionId{99}};
  EXPECT_EQ(look({mug_, box_again}).seen[1].object, box);
  collector_->regionsMerged(mug_.region, box_again.region);
  EXPECT_TRUE(look({mug_}).merged.empty());
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(ObjectCollectorTest, ObjectsThatAPersonSettledStayTwoWhenTheirRegionsJoin) {
  const FrameObjects first = look({mug_, box_, cup_});
  ASSERT_TRUE(person_->rename(first.added.at(0).id, "my mug"));
  ASSERT_TRUE(person_->setConfirmed(std::array{first.added.at(1).id}, true));
  static_cast<void>(look({mug_, box_, cup_}));
  collector_->regionsMerged(mug_.region, box_.region);
  EXPECT_TRUE(look({mug_, cup_}).merged.empty());
  // With one that nobody said anything of, the name stays.
  collector_->regionsMerged(cup_.region, mug_.region);
  ASSERT_EQ(look({cup_}).merged.size(), 1U);
  EXPECT_EQ(collector_->record(collector_->objectOf(cup_.region))->name, "my mug");
}

TEST_F(ObjectCollectorTest, AJoinedRegionOfADeletedObjectIsTheOtherOne) {
  const FrameObjects first = look({mug_, box_});
  ASSERT_TRUE(person_->remove(std::array{first.added.at(0).id}));
  static_cast<void>(look({}));
  collector_->regionsMerged(mug_.region, box_.region);
  EXPECT_TRUE(look({mug_}).merged.empty());
  EXPECT_EQ(collector_->objectOf(mug_.region), first.added.at(1).id);
}

TEST_F(ObjectCollectorTest, WhatAnotherProgramAddsIsRecognised) {
  static_cast<void>(look({box_}));
  const Candidate candidate = mug_.candidate();
  RgbdFrame frame;
  frame.color = cv::Mat(240, 320, CV_8UC3, cv::Scalar(90, 20, 10));
  frame.depth = cv::Mat(240, 320, CV_16UC1, cv::Scalar(1000));
  mug_.paint(frame.color);
  const Result<ObjectRecord> other =
      person_->addObject(*cutView(frame, Eigen::Isometry3d::Identity(), inColor(), candidate));
  ASSERT_TRUE(other);
  const FrameObjects seen = look({mug_});
  ASSERT_EQ(seen.recognised.size(), 1U);
  EXPECT_EQ(seen.recognised[0].id, other->id);
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(ObjectCollectorTest, ALockedCatalogueIsSaidOnceAndWhatIsMetAgainIsAddedLater) {
  static_cast<void>(look({box_}));
  {
    QSqlDatabase other = QSqlDatabase::addDatabase("QSQLITE", "lock");
    other.setDatabaseName(QString::fromStdString(file()));
    ASSERT_TRUE(other.open());
    ASSERT_TRUE(QSqlQuery(other).exec("BEGIN IMMEDIATE"));
    const FrameObjects locked = look({box_, mug_, cup_}, 60);
    ASSERT_TRUE(locked.catalogue_failure);
    EXPECT_THAT(locked.catalogue_failure->message(), HasSubstr(file()));
    EXPECT_THAT(locked.catalogue_failure->message(), HasSubstr("locked"));
    EXPECT_TRUE(locked.added.empty());
    EXPECT_EQ(locked.seen.size(), 3U);
    EXPECT_TRUE(locked.seen[0].object) << "what is known stays known";
    const FrameObjects next = look({box_, mug_});
    EXPECT_FALSE(next.catalogue_failure);
    EXPECT_TRUE(next.added.empty());
    ASSERT_TRUE(QSqlQuery(other).exec("ROLLBACK"));
  }
  QSqlDatabase::removeDatabase("lock");
  std::size_t added = 0;
  for (int frame = 0; frame < ObjectCollector::kFramesUntilRetry; ++frame) {
    const FrameObjects seen = look({box_, mug_, cup_}, 60);
    EXPECT_FALSE(seen.catalogue_failure);
    added += seen.added.size();
  }
  EXPECT_EQ(added, 2U);
  EXPECT_EQ(objects().size(), 3U);
}

TEST_F(ObjectCollectorTest, ACatalogueThatCannotBeReadEndsNothing) {
  static_cast<void>(look({box_}));
  {
    QSqlDatabase other = QSqlDatabase::addDatabase("QSQLITE", "damage");
    other.setDatabaseName(QString::fromStdString(file()));
    ASSERT_TRUE(other.open());
    ASSERT_TRUE(QSqlQuery(other).exec("ALTER TABLE events RENAME TO gone"));
    EXPECT_TRUE(look({box_}).catalogue_failure);
    EXPECT_FALSE(look({box_, mug_}).catalogue_failure);
    ASSERT_TRUE(QSqlQuery(other).exec("ALTER TABLE gone RENAME TO events"));
  }
  QSqlDatabase::removeDatabase("damage");
  std::size_t added = 0;
  for (int frame = 0; frame < ObjectCollector::kFramesUntilRetry; ++frame)
    added += look({box_, mug_}).added.size();
  EXPECT_EQ(added, 1U);
}

}  // namespace
}  // namespace scantrove
