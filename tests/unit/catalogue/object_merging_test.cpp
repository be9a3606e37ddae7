#include <gmock/gmock.h>

#include <algorithm>

#include <sstream>

#include "catalogue_test_support.h"

namespace scantrove::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using Ids = std::vector<ObjectId>;

class ObjectMergingTest : public CatalogueTest {
 protected:
  void SetUp() override {
    database_ = openOrFail(file());
    ASSERT_NE(database_, nullptr);
  }

  ObjectId add(int views = 1, const Eigen::Vector3f& size_m = {0.3F, 0.2F, 0.1F}) {
    ObjectView view = randomView(next_seed_++);
    view.size_m = size_m;
    view.object = database_->addObject(view)->id;
    for (int i = 1; i < views; ++i) EXPECT_TRUE(database_->addView(view));
    return view.object;
  }
  /// An object with one view, of `frame` of `session`.
  ObjectId addFrom(std::int64_t session, int frame) {
    ObjectView view = randomView(frame);
    view.session = session;
    return database_->addObject(view)->id;
  }
  [[nodiscard]] ObjectRecord record(ObjectId id) const { return *database_->object(id); }
  /// The visible objects and their views, as one text.
  [[nodiscard]] std::string visibleState() const {
    std::ostringstream text;
    const auto objects = database_->objects();
    for (const ObjectRecord& object : *objects) {
      text << object.id.value << object.name << static_cast<int>(object.named_by) << object.confirmed
           << object.size_m.transpose()
           << askDatabase(file(),
                          QString("SELECT best_view FROM objects WHERE id = %1").arg(object.id.value));
      const auto views = database_->views().of(object.id);
      for (const ObjectView& view : *views) text << ' ' << view.id;
      text << ';';
    }
    return text.str();
  }

  std::unique_ptr<ObjectDatabase> database_;
  int next_seed_ = 0;
};

TEST_F(ObjectMergingTest, RestoresRemovedObjects) {
  const Ids ids{add(), add(), add()};
  const Ids first_two{ids[0], ids[1]};
  EXPECT_TRUE(database_->remove(first_two));
  EXPECT_EQ(database_->objects()->size(), 1U);
  EXPECT_FALSE(*database_->mergeRoot(ids[0]));
  const Result<ObjectRecord> removed = database_->object(ids[0]);
  ASSERT_FALSE(removed);
  EXPECT_THAT(removed.error().message(), HasSubstr("deleted"));
  EXPECT_TRUE(database_->restore(first_two));
  EXPECT_EQ(record(ids[0]).views, 1);
  EXPECT_EQ(database_->objects()->size(), 3U);
}

TEST_F(ObjectMergingTest, DiscardedViewsBecomeARemovedObject) {
  const std::int64_t session = *database_->sessions().begin("demo"),
                     other = *database_->sessions().begin("other");
  const auto viewOf = [&](ObjectId object, int frame, std::int64_t of_session, float size_m) {
    ObjectView view = randomView(frame);
    view.object = object;
    view.session = of_session;
    view.size_m = Eigen::Vector3f::Constant(size_m);
    return view;
  };
  const ObjectId mug = database_->addObject(viewOf({}, 1, session, 0.1F))->id;
  ASSERT_TRUE(database_->addView(viewOf(mug, 2, session, 0.2F)));
  ASSERT_TRUE(database_->addView(viewOf(mug, 3, session, 0.2F)));
  ASSERT_TRUE(database_->addView(viewOf(mug, 1, other, 0.2F)));
  const int one[] = {1};
  ASSERT_TRUE(database_->discardViews(mug, session, one));
  EXPECT_EQ(record(mug).views, 3);
  EXPECT_FLOAT_EQ(record(mug).size_m.x(), 0.2F);
  EXPECT_EQ(database_->views().of(mug)->front().frame_index, 2);
  EXPECT_EQ(database_->views().count().value(), 4) << "nothing is deleted";
  // They form a removed object of their own.
  const ObjectId discarded{mug.value + 1};
  EXPECT_FALSE(*database_->mergeRoot(discarded));
  ASSERT_TRUE(database_->restore(Ids{discarded}));
  EXPECT_EQ(record(discarded).views, 1);
  EXPECT_FLOAT_EQ(record(discarded).size_m.x(), 0.1F);
  int of_discarded = 0;
  ASSERT_TRUE(database_->views().forEachDescriptor(0, [&](const StoredDescriptor& descriptor) {
    of_discarded += descriptor.first_object == discarded ? 1 : 0;
  }));
  EXPECT_EQ(of_discarded, 1) << "recognition attributes the view to it, too";
}

TEST_F(ObjectMergingTest, NamesCountWithoutGaps_WhenViewsAreDiscarded) {
  const std::int64_t session = *database_->sessions().begin("demo");
  const int frames[] = {1};
  const auto addAndDiscardAView = [&] {
    ObjectView view = randomView(2);
    view.object = addFrom(session, 1);
    view.session = session;
    EXPECT_TRUE(database_->addView(view));
    EXPECT_EQ(database_->discardViews(view.object, session, frames), false);
    return view.object;
  };
  const Ids ids{addAndDiscardAView(), addAndDiscardAView(), addAndDiscardAView()};
  EXPECT_EQ(record(ids[0]).name, "Obj_1");
  EXPECT_EQ(record(ids[1]).name, "Obj_2");
  EXPECT_EQ(record(ids[2]).name, "Obj_3");
  // A user may have seen the names of objects that are gone.
  EXPECT_TRUE(database_->remove({&ids[2], 1}));
  ASSERT_TRUE(database_->merge({ids.data(), 2}));
  EXPECT_EQ(record(add()).name, "Obj_4");
}

TEST_F(ObjectMergingTest, DiscardsTheOlderOfTwoViewsOfAFrame) {
  const std::int64_t session = *database_->sessions().begin("demo");
  const ObjectId mug = addFrom(session, 1);
  const auto addView = [&] {
    ObjectView view = randomView(1);
    view.object = mug;
    view.session = session;
    return *database_->addView(view);
  };
  const std::int64_t second = addView(), third = addView();
  const int once[] = {1};
  EXPECT_EQ(database_->discardViews(mug, session, once), false);
  std::vector<std::int64_t> left;
  const auto views = database_->views().of(mug);
  ASSERT_TRUE(views) << views.error().message();
  for (const ObjectView& view : *views) left.push_back(view.id);
  EXPECT_THAT(left, testing::ElementsAre(second, third));
  const int twice[] = {1, 1};
  EXPECT_EQ(database_->discardViews(mug, session, twice), true) << "the object has no other views";
}

TEST_F(ObjectMergingTest, DiscardingAllViewsRemovesTheObject_UnlessNamedOrConfirmed) {
  const std::int64_t session = *database_->sessions().begin("demo");
  const ObjectId patch = addFrom(session, 1), named = addFrom(session, 2), confirmed = addFrom(session, 3);
  ASSERT_TRUE(database_->rename(named, "mug"));
  ASSERT_TRUE(database_->setConfirmed(Ids{confirmed}, true));
  const int frames[] = {1, 2, 3};
  for (const ObjectId object : {patch, named, confirmed, patch})
    ASSERT_TRUE(database_->discardViews(object, session, frames)) << object.value;
  EXPECT_EQ(database_->objects()->size(), 2U);
  EXPECT_FALSE(*database_->mergeRoot(patch));
  ASSERT_TRUE(database_->restore(Ids{patch}));
  EXPECT_EQ(record(patch).views, 1);
}

TEST_F(ObjectMergingTest, DiscardedViewsLeaveTheRoot_WhenTheObjectIsMerged) {
  const std::int64_t session = *database_->sessions().begin("demo");
  const Ids pair{addFrom(session, 1), addFrom(session, 2)};
  const ObjectMerge merge = *database_->merge(pair);
  const int frames[] = {1, 2};
  ASSERT_TRUE(database_->discardViews(merge.from.front(), session, frames));
  EXPECT_EQ(record(merge.into).views, 1) << "only the view of the merged object was discarded";
}

TEST_F(ObjectMergingTest, ChangesNothing_WhenOneOfSeveralObjectsIsHiddenOrUnknown) {
  const Ids ids{add(), add(), add()};
  EXPECT_TRUE(database_->remove({&ids[1], 1}));
  const std::string before = visibleState(), events = askDatabase(file(), "SELECT count(*) FROM events");
  EXPECT_FALSE(database_->remove(ids));
  EXPECT_FALSE(database_->setConfirmed(ids, true));
  EXPECT_FALSE(database_->merge(ids));
  const Ids unknown{ids[0], ObjectId{99}};
  EXPECT_FALSE(database_->remove(unknown));
  EXPECT_FALSE(database_->restore(unknown));
  EXPECT_EQ(visibleState(), before);
  EXPECT_EQ(askDatabase(file(), "SELECT count(*) FROM events"), events);

  const Ids twice{ids[0], ids[0], ids[2]};
  EXPECT_TRUE(database_->setConfirmed(twice, true));
  EXPECT_TRUE(record(ids[2]).confirmed);
  EXPECT_TRUE(database_->remove(twice));
  EXPECT_TRUE(database_->objects()->empty());
}

TEST_F(ObjectMergingTest, MergePrefersNamedThenConfirmedThenOldestAsRoot) {
  const ObjectId oldest = add(), seen_more = add(3), confirmed = add(), named = add();
  EXPECT_TRUE(database_->setConfirmed({&confirmed, 1}, true));
  EXPECT_TRUE(database_->rename(named, "Obj_50"));  // typed on purpose

  EXPECT_EQ(database_->merge(Ids{seen_more, oldest})->into, oldest) << "the older object keeps its number";
  EXPECT_EQ(database_->merge(Ids{oldest, confirmed})->into, confirmed);
  const ObjectMerge last = *database_->merge(Ids{confirmed, named});
  EXPECT_EQ(last.into, named);
  EXPECT_THAT(last.from, ElementsAre(confirmed));
  EXPECT_EQ(record(named).name, "Obj_50");
  EXPECT_EQ(record(named).views, 6);
  EXPECT_TRUE(record(named).confirmed) << "the user's confirmation is kept";
}

TEST_F(ObjectMergingTest, UnmergeRestoresTheStateBefore) {
  const ObjectId a = add(2, {0.3F, 0.2F, 0.1F}), b = add(1, {0.5F, 0.3F, 0.2F}),
                 c = add(4, {0.9F, 0.1F, 0.1F});
  EXPECT_TRUE(database_->rename(b, "mug"));
  EXPECT_TRUE(database_->setConfirmed({&a, 1}, true));
  const std::string before = visibleState();
  const Result<ObjectMerge> merge = database_->merge(Ids{a, b, c});
  ASSERT_TRUE(merge);
  EXPECT_EQ(merge->into, b);
  EXPECT_EQ(record(b).views, 7);
  EXPECT_TRUE(record(b).confirmed);
  EXPECT_EQ(record(b).size_m, Eigen::Vector3f(0.9F, 0.1F, 0.1F));  // the size in most views
  EXPECT_NE(visibleState(), before);
  EXPECT_TRUE(database_->unmerge(*merge));
  EXPECT_EQ(visibleState(), before);
  EXPECT_EQ(record(a).name, "Obj_1");
  EXPECT_EQ(record(a).named_by, NamedBy::program);

  const Result<void> again = database_->unmerge(*merge);
  ASSERT_FALSE(again);
  EXPECT_THAT(again.error().message(), HasSubstr("not merged"));
  EXPECT_EQ(visibleState(), before);
}

TEST_F(ObjectMergingTest, RevertedMergeLeavesWhatOthersDidSince) {
  const ObjectId a = add(1), b = add(2), c = add(4);
  const Result<ObjectMerge> joined = database_->merge(Ids{a, b});
  ASSERT_TRUE(joined);
  const ObjectId into = joined->into, part = joined->from.front();
  // Somebody separates them, and merges the part by way of a third object.
  EXPECT_TRUE(database_->unmerge(*joined));
  EXPECT_FALSE(database_->revertMerge(*joined).value_or(true));
  EXPECT_TRUE(database_->rename(c, "cup"));
  EXPECT_TRUE(database_->merge(Ids{part, c}));
  EXPECT_TRUE(database_->rename(into, "mug"));
  EXPECT_TRUE(database_->merge(Ids{c, into}));
  const std::string before = visibleState();
  EXPECT_FALSE(database_->revertMerge(*joined).value_or(true));
  EXPECT_EQ(visibleState(), before);
}

TEST_F(ObjectMergingTest, RevertedMergeParts_WhenTheObjectWasMergedAgain) {
  const ObjectId a = add(1), b = add(2), c = add(4);
  const Result<ObjectMerge> joined = database_->merge(Ids{a, b});
  ASSERT_TRUE(joined);
  EXPECT_TRUE(database_->rename(c, "mug"));
  EXPECT_TRUE(database_->merge(Ids{joined->into, c}));
  EXPECT_EQ(record(c).views, 7);
  EXPECT_TRUE(database_->revertMerge(*joined).value_or(false));
  const ObjectId part = joined->from.front();
  EXPECT_EQ(*database_->mergeRoot(part), part);
  EXPECT_EQ(record(c).views + record(part).views, 7);
}

TEST_F(ObjectMergingTest, ViewsFollowNestedMerges) {
  const ObjectId a = add(), b = add(2), c = add(4);
  EXPECT_TRUE(database_->setConfirmed({&b, 1}, true));
  EXPECT_TRUE(database_->rename(c, "mug"));
  EXPECT_FALSE(database_->merge(Ids{a, a}));
  EXPECT_FALSE(database_->merge(Ids{a}));
  const ObjectMerge first = *database_->merge(Ids{a, b}), second = *database_->merge(Ids{b, c});
  EXPECT_EQ(database_->objects()->size(), 1U);
  EXPECT_EQ(record(c).views, 7);
  EXPECT_EQ(*database_->mergeRoot(a), c);
  ObjectView late = randomView(4);  // from a scan that still tracks `a`
  late.object = a;
  EXPECT_TRUE(database_->addView(late));
  EXPECT_EQ(record(c).views, 8);
  EXPECT_FALSE(database_->merge(Ids{c, a}));
  EXPECT_FALSE(database_->unmerge({c, {a}, false}));  // it was merged into b
  EXPECT_FALSE(database_->restore({&a, 1}));

  EXPECT_TRUE(database_->unmerge(second));  // b is restored together with a's views
  EXPECT_EQ(record(c).views, 4);
  EXPECT_EQ(record(b).views, 4);
  EXPECT_EQ(*database_->mergeRoot(a), b);
  EXPECT_TRUE(database_->unmerge(first));
  EXPECT_EQ(record(a).views, 2);
  EXPECT_EQ(record(b).views, 2);
  EXPECT_TRUE(sameImage(database_->views().of(a)->front().color, randomView(0).color));
}

TEST_F(ObjectMergingTest, SizeIsTheMedianOfViewsAndPictureTheLargest) {
  const ObjectId id = add(1, {0.1F, 0.1F, 0.1F});
  const auto addView = [&](const Eigen::Vector3f& size_m, int side_px) {
    ObjectView view = randomView(next_seed_++, {side_px, side_px});
    view.mask.setTo(255);
    view.object = id;
    view.size_m = size_m;
    EXPECT_TRUE(database_->addView(view));
  };
  addView({0.3F, 0.2F, 0.1F}, 60);
  EXPECT_EQ(record(id).size_m, Eigen::Vector3f(0.2F, 0.15F, 0.1F));
  addView({9.0F, 8.0F, 7.0F}, 50);  // one wrong view
  EXPECT_EQ(record(id).size_m, Eigen::Vector3f(0.3F, 0.2F, 0.1F));
  addView({0, 0, 0}, 10);  // of unknown size
  EXPECT_EQ(record(id).size_m, Eigen::Vector3f(0.3F, 0.2F, 0.1F));
  EXPECT_EQ(database_->views().picture(id)->size(), cv::Size(60, 60)) << "the view with most object pixels";
  const auto pictures = database_->views().pictures(id);
  ASSERT_TRUE(pictures);
  ASSERT_EQ(pictures->size(), 4U);
  EXPECT_EQ((*pictures)[0].size(), cv::Size(10, 10)) << "the newest first";
  EXPECT_EQ((*pictures)[2].size(), cv::Size(60, 60));
}

TEST_F(ObjectMergingTest, UnmergedViewsLeaveTheOuterRoot_WhenMergesAreNested) {
  const Eigen::Vector3f small(0.1F, 0.1F, 0.1F), large(0.9F, 0.8F, 0.7F);
  const Ids ids{add(1, small), add(1, small), add(4, large)};
  const std::string before = visibleState();
  const Result<ObjectMerge> first = database_->merge(Ids{ids[1], ids[2]});
  ASSERT_TRUE(first);
  const Result<ObjectMerge> second = database_->merge(Ids{ids[0], ids[1]});
  ASSERT_TRUE(second);
  EXPECT_EQ(record(ids[0]).size_m, large) << "most of the views";
  const std::int64_t event = *database_->lastEvent();
  ASSERT_TRUE(database_->unmerge(*first));
  EXPECT_TRUE(std::ranges::any_of(database_->changesAfter(event)->changes,
                                  [&](const CatalogueChange& change) {
                                    return change.kind == CatalogueChange::Kind::views_discarded &&
                                           change.object() == ids[0];
                                  }))
      << "an event tells other connections to read its record again";
  EXPECT_EQ(record(ids[0]).views, 2);
  EXPECT_EQ(record(ids[0]).size_m, small);
  const cv::Mat picture = *database_->views().picture(ids[0]);
  EXPECT_TRUE(std::ranges::any_of(*database_->views().pictures(ids[0]), [&](const cv::Mat& own) {
    return sameImage(own, picture);
  })) << "the picture is of its own views";
  ASSERT_TRUE(database_->unmerge(*second));
  EXPECT_EQ(visibleState(), before);
}

TEST_F(ObjectMergingTest, UnmergeResetsTheSize_WhenItWasUnknown) {
  const Ids ids{add(1, Eigen::Vector3f::Zero()), add(1)};
  const Result<ObjectMerge> merge = database_->merge(ids);
  ASSERT_TRUE(merge);
  ASSERT_EQ(merge->into, ids[0]);
  EXPECT_FALSE(record(ids[0]).size_m.isZero());
  ASSERT_TRUE(database_->unmerge(*merge));
  EXPECT_TRUE(record(ids[0]).size_m.isZero());
  EXPECT_FALSE(record(ids[1]).size_m.isZero());
}

TEST_F(ObjectMergingTest, WithdrawFails_WhenNamedConfirmedOrMerged) {
  const Ids ids{add(), add(), add(), add(), add()};
  EXPECT_TRUE(database_->setConfirmed(Ids{ids[0]}, true));
  EXPECT_TRUE(database_->rename(ids[1], "mug"));
  ASSERT_TRUE(database_->merge(Ids{ids[2], ids[3]}));
  for (int i = 0; i < 4; ++i)
    EXPECT_FALSE(database_->withdraw(ids[static_cast<std::size_t>(i)]).value_or(true));
  EXPECT_EQ(database_->objects()->size(), 4U) << "another object is merged into the third";
  EXPECT_TRUE(database_->withdraw(ids[4]).value_or(false));
  EXPECT_FALSE(database_->withdraw(ids[4]).value_or(true)) << "only once";
}

TEST_F(ObjectMergingTest, ModelHasTheMergeRootOfEachObject) {
  const ObjectId a = add(), b = add(2), c = add(4), d = add();
  ASSERT_TRUE(database_->setConfirmed({&b, 1}, true));
  ASSERT_TRUE(database_->rename(c, "mug"));
  ASSERT_TRUE(database_->merge(Ids{a, b}));
  ASSERT_TRUE(database_->merge(Ids{b, c}));
  ASSERT_TRUE(database_->remove({&d, 1}));
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  const Result<CatalogueModel> model = database_->model();
  ASSERT_TRUE(model);
  for (const auto& [id, object] : model->objects()) found.emplace_back(id.value, model->mergeRoot(id).value);
  EXPECT_THAT(found, ElementsAre(std::pair(1, 3), std::pair(2, 3), std::pair(3, 3), std::pair(4, 0)));
}

TEST_F(ObjectMergingTest, MergeRootIsNone_WhenMergesAreCyclicOrDangling) {
  const Ids ids{add(), add(), add(), add()};
  askDatabase(file(), "UPDATE objects SET hidden = 1, merged_into = 2 WHERE id = 1");
  askDatabase(file(), "UPDATE objects SET hidden = 1, merged_into = 1 WHERE id = 2");
  askDatabase(file(), "UPDATE objects SET hidden = 1, merged_into = 77 WHERE id = 3");
  askDatabase(file(), "UPDATE objects SET merged_into = 4 WHERE id = 4");
  EXPECT_FALSE(*database_->mergeRoot(ids[0]));
  EXPECT_FALSE(*database_->mergeRoot(ids[2]));
  EXPECT_EQ(*database_->mergeRoot(ids[3]), ids[3]);
  const Result<CatalogueModel> model = database_->model();
  ASSERT_TRUE(model);
  for (const ObjectId id : ids) EXPECT_EQ(model->mergeRoot(id), id == ids[3] ? id : ObjectId{}) << id.value;
  ObjectView late = randomView(4);
  late.object = ids[0];
  EXPECT_TRUE(database_->addView(late));
  EXPECT_TRUE(database_->unmerge({ids[1], {ids[0]}, false}));
  EXPECT_EQ(*database_->mergeRoot(ids[1]), ids[0]);
}

}  // namespace
}  // namespace scantrove::test
