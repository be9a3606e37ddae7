#include "core/scan/object_collector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QSqlDatabase>
#include <QSqlQuery>
#include <algorithm>
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
    candidate.regions = {region};
    candidate.outline = 1;
    candidate.is_whole = true;
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

  [[nodiscard]] static DetectionParams params() {
    DetectionParams params;
    params.new_view_angle_deg = 20;
    return params;
  }

  void beginScan() {
    std::int64_t session = 0;
    moveIn(session, database_->beginSession("table"));
    moveIn(collector_, ObjectCollector::create(*compute_, *database_, session, params()));
  }

  static SurfaceInColor inColor() {
    return locateInColor(std::nullopt, kWorking, Eigen::Isometry3d::Identity(), {});
  }

  /// One frame that shows `things` from a direction about the vertical.
  FrameObjects look(const std::vector<Thing>& things, double degrees = 0) {
    std::vector<Candidate> candidates;
    for (const Thing& thing : things) candidates.push_back(thing.candidate());
    return lookAt(candidates, things, degrees);
  }
  FrameObjects lookAt(const std::vector<Candidate>& candidates, const std::vector<Thing>& things,
                      double degrees = 0) {
    RgbdFrame frame;
    frame.index = frame_++;
    frame.color = cv::Mat(240, 320, CV_8UC3, cv::Scalar(40, 50, 60));
    frame.depth = cv::Mat(240, 320, CV_16UC1, cv::Scalar(1000));
    for (const Thing& thing : things) thing.paint(frame.color);
    PoseEstimate pose;
    pose.state = TrackingState::tracking;
    const double angle = degrees * 3.14159265 / 180;
    pose.T_world_camera = Eigen::Translation3d(30 * std::sin(angle), 0, -30 * std::cos(angle));
    return collector_->collect(frame, pose, inColor(), candidates);
  }

  /// So many such frames that what is unknown counts as unknown; all that they gave, seen as in the last.
  FrameObjects study(const std::vector<Thing>& things, double degrees = 0) {
    FrameObjects all;
    for (int i = 0; i <= RecognitionHistory::kLooksToGiveUp * RecognitionHistory::kFramesApart; ++i) {
      FrameObjects one = look(things, degrees);
      std::ranges::move(one.added, std::back_inserter(all.added));
      std::ranges::move(one.recognised, std::back_inserter(all.recognised));
      std::ranges::move(one.new_views, std::back_inserter(all.new_views));
      std::ranges::move(one.merged, std::back_inserter(all.merged));
      all.seen = std::move(one.seen);
    }
    return all;
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
  FrameObjects first = study({mug_, box_});
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
  DetectionParams few = params();
  few.max_views = 3;
  collector_->setParams(few);
  static_cast<void>(study({mug_}));
  for (int i = 0; i < 6; ++i) static_cast<void>(look({mug_}, 25 * i));
  EXPECT_EQ(objects().at(0).views, 3);
}

TEST_F(ObjectCollectorTest, RecognisesWhatAnEarlierScanAddedAndSaysSoOnce) {
  const ObjectId mug = study({mug_}).added.at(0).id;
  beginScan();
  const FrameObjects first = study({mug_, box_});
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
  const ObjectId mug = study({mug_}).added.at(0).id;
  for (int frame = 0; frame < 20; ++frame) static_cast<void>(look({}));
  const Thing again{7, mug_.place, RegionId{77}};  // even when it looks like another
  EXPECT_TRUE(study({again}).added.empty());
  EXPECT_EQ(collector_->objectOf(again.region), mug);
}

TEST_F(ObjectCollectorTest, WhatAPersonDeletedIsNotAddedAgainAndComesBackWithUndo) {
  const ObjectId mug = study({mug_, box_}).added.at(0).id;
  ASSERT_TRUE(person_->remove(std::array{mug}));
  const Thing under_a_new_region{mug_.seed, mug_.place, RegionId{77}};
  for (int frame = 0; frame < 20; ++frame) {
    const FrameObjects seen = look({mug_, box_}, 25 * frame);
    EXPECT_TRUE(seen.added.empty() && seen.recognised.empty());
    EXPECT_FALSE(seen.seen[0].object);
    EXPECT_EQ(seen.seen[0].name, "");
  }
  for (int frame = 0; frame < 20; ++frame) static_cast<void>(look({}));
  for (int frame = 0; frame < 40; ++frame)
    EXPECT_TRUE(look({under_a_new_region, box_}, 25 * frame).added.empty());
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
  const ObjectId mug = study({mug_}).added.at(0).id;
  ASSERT_TRUE(person_->rename(mug, "my mug"));
  ASSERT_TRUE(person_->setConfirmed(std::array{mug}, true));
  const FrameObjects seen = look({mug_});
  EXPECT_EQ(seen.seen[0].name, "my mug");
  EXPECT_TRUE(seen.seen[0].confirmed);
}

TEST_F(ObjectCollectorTest, AMergeByAPersonIsFollowedAndSoIsItsUndo) {
  const FrameObjects first = study({mug_, box_});
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
  const FrameObjects first = study({mug_, box_});
  const ObjectId mug = first.added.at(0).id, box = first.added.at(1).id;
  collector_->regionsJoined(mug_.region, box_.region);
  const FrameObjects joined = look({mug_});
  ASSERT_EQ(joined.merged.size(), 1U);
  EXPECT_EQ(joined.merged[0].into, mug) << "the older of equals";
  EXPECT_EQ(joined.seen[0].object, mug);
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_EQ(objects()[0].views, 2);
  ASSERT_TRUE(person_->unmerge(joined.merged[0]));
  for (int frame = 0; frame < 20; ++frame) static_cast<void>(look({mug_}));
  const Thing box_again{box_.seed, box_.place, RegionId{99}};
  EXPECT_EQ(look({mug_, box_again}).seen[1].object, box);
  collector_->regionsJoined(mug_.region, box_again.region);
  EXPECT_TRUE(look({mug_}).merged.empty());
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(ObjectCollectorTest, ObjectsThatAPersonSettledStayTwoWhenTheirRegionsJoin) {
  const FrameObjects first = study({mug_, box_, cup_});
  ASSERT_TRUE(person_->rename(first.added.at(0).id, "my mug"));
  ASSERT_TRUE(person_->setConfirmed(std::array{first.added.at(1).id}, true));
  static_cast<void>(look({mug_, box_, cup_}));
  collector_->regionsJoined(mug_.region, box_.region);
  EXPECT_TRUE(look({mug_, cup_}).merged.empty());
  // With one that nobody said anything of, the name stays.
  collector_->regionsJoined(cup_.region, mug_.region);
  ASSERT_EQ(look({cup_}).merged.size(), 1U);
  EXPECT_EQ(collector_->record(collector_->objectOf(cup_.region))->name, "my mug");
}

TEST_F(ObjectCollectorTest, AJoinedRegionOfADeletedObjectIsTheOtherOne) {
  const FrameObjects first = study({mug_, box_});
  ASSERT_TRUE(person_->remove(std::array{first.added.at(0).id}));
  static_cast<void>(look({}));
  collector_->regionsJoined(mug_.region, box_.region);
  EXPECT_TRUE(look({mug_}).merged.empty());
  EXPECT_EQ(collector_->objectOf(mug_.region), first.added.at(1).id);
}

TEST_F(ObjectCollectorTest, WhatAnotherProgramAddsIsRecognised) {
  static_cast<void>(study({box_}));
  const Candidate candidate = mug_.candidate();
  RgbdFrame frame;
  frame.color = cv::Mat(240, 320, CV_8UC3, cv::Scalar(90, 20, 10));
  frame.depth = cv::Mat(240, 320, CV_16UC1, cv::Scalar(1000));
  mug_.paint(frame.color);
  const Result<ObjectRecord> other =
      person_->addObject(*cutView(frame, Eigen::Isometry3d::Identity(), inColor(), candidate));
  ASSERT_TRUE(other);
  const FrameObjects seen = study({mug_});
  ASSERT_EQ(seen.recognised.size(), 1U);
  EXPECT_EQ(seen.recognised[0].id, other->id);
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(ObjectCollectorTest, ALockedCatalogueIsSaidOnceAndWhatIsMetAgainIsAddedLater) {
  static_cast<void>(study({box_}));
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
  static_cast<void>(study({box_}));
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

TEST_F(ObjectCollectorTest, WhatIsNotWholeStaysACandidateUntilAPersonWantsIt) {
  Candidate part = mug_.candidate();
  part.is_whole = false;
  FrameObjects seen;
  for (int frame = 0; frame < 40; ++frame) {
    seen = lookAt({part}, {mug_});
    EXPECT_TRUE(seen.added.empty());
  }
  ASSERT_EQ(seen.seen.size(), 1U);
  EXPECT_FALSE(seen.seen[0].object);
  collector_->addByPerson(mug_.region);
  seen = lookAt({part}, {mug_});
  ASSERT_EQ(seen.added.size(), 1U);
  EXPECT_EQ(seen.seen[0].object, seen.added[0].id);
  EXPECT_TRUE(lookAt({part}, {mug_}).added.empty()) << "once";
}

TEST_F(ObjectCollectorTest, SaysUnknownOnlyAfterSeveralLooks) {
  int frames = 0;
  while (look({mug_}).added.empty()) ASSERT_LT(++frames, 100);
  EXPECT_GE(frames, (RecognitionHistory::kLooksToGiveUp - 1) * RecognitionHistory::kFramesApart);
}

TEST_F(ObjectCollectorTest, OfCandidatesThatShareRegionsTheKnownOneIsTaken) {
  Candidate both = mug_.candidate();
  both.regions.add(box_.region);
  both.odds = 1;  // likelier than its parts
  const ObjectId mug = study({mug_}).added.at(0).id;
  static_cast<void>(lookAt({both, mug_.candidate()}, {mug_}));
  ASSERT_TRUE(person_->setConfirmed(std::array{mug}, true));
  const FrameObjects seen = lookAt({mug_.candidate(), both, box_.candidate()}, {mug_, box_});
  EXPECT_EQ(std::ranges::count(seen.seen, mug, &SeenObject::object), 1);
}

TEST_F(ObjectCollectorTest, WhatStandsWithAnObjectInALargerSetStaysFree) {
  ASSERT_EQ(study({mug_}).added.size(), 1U);
  Candidate both = mug_.candidate();
  both.regions.add(box_.region);
  both.size_m *= 2;
  static_cast<void>(lookAt({both}, {mug_, box_}));
  EXPECT_FALSE(collector_->objectOf(box_.region));
  EXPECT_EQ(study({mug_, box_}).added.size(), 1U) << "the box is an object of its own";
}

TEST_F(ObjectCollectorTest, TwoEntriesThatAreOnePlaceBecomeOne) {
  const ObjectId mug = study({mug_}).added.at(0).id;
  // Met again after a long time under another region, and 0.3 of its size away: a second entry.
  Candidate beside = mug_.candidate();
  beside.regions = {RegionId{77}};
  beside.centroid_world.x() += 0.3F * kSize.norm();
  const Thing other{9, mug_.place, RegionId{77}};
  for (int frame = 0; frame < 20; ++frame) static_cast<void>(look({}));
  ObjectId second;
  for (int frame = 0; frame < 40 && !second; ++frame) {
    const FrameObjects seen = lookAt({beside}, {other});
    if (!seen.added.empty()) second = seen.added[0].id;
  }
  ASSERT_TRUE(second);
  ASSERT_NE(second, mug);
  // Seen better it stands where the first stood.
  beside.centroid_world = mug_.centroid();
  std::vector<ObjectMerge> merged;
  for (int frame = 0; frame < 5; ++frame)
    std::ranges::copy(lookAt({beside}, {other}).merged, std::back_inserter(merged));
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_EQ(objects().size(), 1U);
}

TEST_F(ObjectCollectorTest, ThingsThatWereSeenSideBySideStayTwo) {
  const FrameObjects first = study({mug_, box_});
  ASSERT_EQ(first.added.size(), 2U);
  Candidate moved = box_.candidate();
  moved.centroid_world = mug_.centroid();
  for (int frame = 0; frame < 30; ++frame) EXPECT_TRUE(lookAt({moved}, {box_}).merged.empty());
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(ObjectCollectorTest, PartsOfADeletedObjectAreNotAdded) {
  const ObjectId mug = study({mug_}).added.at(0).id;
  ASSERT_TRUE(person_->remove(std::array{mug}));
  static_cast<void>(look({mug_}));
  Thing handle{4, 2, RegionId{78}};
  collector_->regionsParted(mug_.region, handle.region);
  EXPECT_TRUE(study({handle}).added.empty());
  handle.region = RegionId{79};
  EXPECT_EQ(study({{5, 1, RegionId{80}}}).added.size(), 1U) << "what is nobody's part is";
}

}  // namespace
}  // namespace scantrove
