#include "core/catalogue/different_objects.h"

#include <gmock/gmock.h>

#include "core/catalogue/object_details.h"
#include "tests/unit/catalogue/catalogue_test_support.h"

namespace scantrove::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class DifferentObjectsTest : public CatalogueTest {
 protected:
  void SetUp() override {
    database_ = openOrFail(file());
    ASSERT_NE(database_, nullptr);
    for (int i = 0; i < 3; ++i) objects_.push_back(database_->addObject(randomView(i)).value().id);
  }
  [[nodiscard]] std::set<ObjectPair> pairs() const {
    const auto database = openOrFail(file());
    return database->differences().pairs().value();
  }

  std::unique_ptr<ObjectDatabase> database_;
  std::vector<ObjectId> objects_;
};

TEST_F(DifferentObjectsTest, AreKept_AndTakenBack) {
  EXPECT_THAT(pairs(), IsEmpty());
  ASSERT_TRUE(database_->differences().record(objects_[2], objects_[0], true));
  ASSERT_TRUE(database_->differences().record(objects_[0], objects_[1], true));
  EXPECT_THAT(pairs(),
              ElementsAre(ObjectPair(objects_[0], objects_[1]), ObjectPair(objects_[0], objects_[2])));
  ASSERT_TRUE(database_->differences().record(objects_[0], objects_[2], false));
  EXPECT_THAT(pairs(), ElementsAre(ObjectPair(objects_[0], objects_[1])));
}

TEST_F(DifferentObjectsTest, AreNoChangesOfObjects) {
  const std::int64_t before = database_->lastEvent().value();
  ASSERT_TRUE(database_->differences().record(objects_[0], objects_[1], true));
  EXPECT_THAT(database_->changesAfter(before).value().changes, IsEmpty());
}

TEST_F(DifferentObjectsTest, DetailsHasViewsAndAllIds) {
  ObjectView newer = randomView(7);
  newer.object = objects_[0];
  ASSERT_TRUE(database_->addView(newer));
  const std::vector<ObjectId> merged{objects_[0], objects_[1]};
  ASSERT_TRUE(database_->merge(merged));
  const Result<ObjectDetails> details = readDetails(file(), objects_[0]);
  ASSERT_TRUE(details) << details.error().message();
  EXPECT_EQ(details->catalogue, database_->identity().value());
  EXPECT_THAT(details->ids, ElementsAre(objects_[0], objects_[1]));
  ASSERT_EQ(details->views.size(), 3U);
  EXPECT_EQ(details->views[0].frame_index, 7) << "newest first";
  EXPECT_TRUE(details->cloud.points.empty()) << "the camera is not known";
}

TEST_F(DifferentObjectsTest, DetailsOfAMergedObjectIsAnError) {
  const std::vector<ObjectId> merged{objects_[0], objects_[1]};
  ASSERT_TRUE(database_->merge(merged));
  EXPECT_FALSE(readDetails(file(), objects_[1]));
  EXPECT_FALSE(readDetails(file("missing.sqlite"), objects_[0]));
}

}  // namespace
}  // namespace scantrove::test
