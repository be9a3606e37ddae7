#include <gmock/gmock.h>

#include <algorithm>

#include "catalogue_test_support.h"

namespace scantrove {
namespace {

using test::askSqlite;
using test::openOrFail;
using test::randomView;
using test::sameImage;
using testing::ElementsAre;
using testing::HasSubstr;

using Ids = std::vector<ObjectId>;

class ObjectMerging : public test::CatalogueTest {
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
  /// An object that this session found in that frame.
  ObjectId addOf(std::int64_t session, int frame) {
    ObjectView view = randomView(frame);
    view.session = session;
    return database_->addObject(view)->id;
  }
  [[nodiscard]] ObjectRecord record(ObjectId id) const { return *database_->object(id); }
  /// All that a person sees, and the events, as one text each.
  [[nodiscard]] std::string visibleState() const {
    return askSqlite(
        file(),
        "SELECT group_concat(id || name || named_by_person || confirmed || size_x_m || size_y_m ||"
        " size_z_m || best_view || (SELECT group_concat(v.id) FROM views v WHERE v.object = o.id))"
        " FROM objects o WHERE hidden = 0");
  }

  std::unique_ptr<ObjectDatabase> database_;
  int next_seed_ = 0;
};

TEST_F(ObjectMerging, RemoveAndRestore) {
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

TEST_F(ObjectMerging, ViewsThatShowSomethingElseAreDiscarded) {
  const std::int64_t session = *database_->sessions().begin("demo"),
                     other = *database_->sessions().begin("other");
  const auto view = [&](ObjectId object, int frame, std::int64_t of_session, float size_m) {
    ObjectView made = randomView(frame);
    made.object = object;
    made.session = of_session;
    made.size_m = Eigen::Vector3f::Constant(size_m);
    return made;
  };
  const ObjectId mug = database_->addObject(view({}, 1, session, 0.1F))->id;
  ASSERT_TRUE(database_->addView(view(mug, 2, session, 0.2F)));
  ASSERT_TRUE(database_->addView(view(mug, 3, session, 0.2F)));
  ASSERT_TRUE(database_->addView(view(mug, 1, other, 0.2F)));
  const int one[] = {1};
  ASSERT_TRUE(database_->discardViews(mug, session, one));
  EXPECT_EQ(record(mug).views, 3);
  EXPECT_FLOAT_EQ(record(mug).size_m.x(), 0.2F);
  EXPECT_EQ(database_->views().of(mug)->front().frame_index, 2);
  EXPECT_EQ(database_->views().count().value(), 4) << "nothing is deleted";
  // They are a removed object of their own.
  const ObjectId left{mug.value + 1};
  EXPECT_FALSE(*database_->mergeRoot(left));
  ASSERT_TRUE(database_->restore(Ids{left}));
  EXPECT_EQ(record(left).views, 1);
  EXPECT_FLOAT_EQ(record(left).size_m.x(), 0.1F);
  int of_left = 0;
  ASSERT_TRUE(database_->views().forEachDescriptor(
      0, [&](const StoredDescriptor& descriptor) { of_left += descriptor.first_object == left ? 1 : 0; }));
  EXPECT_EQ(of_left, 1) << "recognition takes it for that one, too";
}

TEST_F(ObjectMerging, AnObjectOfNothingElseIsRemovedUnlessAPersonKnowsIt) {
  const std::int64_t session = *database_->sessions().begin("demo");
  const ObjectId patch = addOf(session, 1), named = addOf(session, 2), confirmed = addOf(session, 3);
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

TEST_F(ObjectMerging, DiscardedViewsOfAMergedObjectLeaveItsRoot) {
  const std::int64_t session = *database_->sessions().begin("demo");
  const Ids pair{addOf(session, 1), addOf(session, 2)};
  const ObjectMerge merge = *database_->merge(pair);
  const int frames[] = {1, 2};
  ASSERT_TRUE(database_->discardViews(merge.from.front(), session, frames));
  EXPECT_EQ(record(merge.into).views, 1) << "only that which was of the merged one";
}

TEST_F(ObjectMerging, SeveralObjectsChangeTogetherOrNotAtAll) {
  const Ids ids{add(), add(), add()};
  EXPECT_TRUE(database_->remove({&ids[1], 1}));
  const std::string before = visibleState(), events = askSqlite(file(), "SELECT count(*) FROM events");
  EXPECT_FALSE(database_->remove(ids));
  EXPECT_FALSE(database_->setConfirmed(ids, true));
  EXPECT_FALSE(database_->merge(ids));
  const Ids unknown{ids[0], ObjectId{99}};
  EXPECT_FALSE(database_->remove(unknown));
  EXPECT_FALSE(database_->restore(unknown));
  EXPECT_EQ(visibleState(), before);
  EXPECT_EQ(askSqlite(file(), "SELECT count(*) FROM events"), events);

  const Ids twice{ids[0], ids[0], ids[2]};
  EXPECT_TRUE(database_->setConfirmed(twice, true));
  EXPECT_TRUE(record(ids[2]).confirmed);
  EXPECT_TRUE(database_->remove(twice));
  EXPECT_TRUE(database_->objects()->empty());
}

TEST_F(ObjectMerging, TheNameOfAPersonIsKeptThenTheConfirmedThenTheOlder) {
  const ObjectId oldest = add(), seen_more = add(3), confirmed = add(), named = add();
  EXPECT_TRUE(database_->setConfirmed({&confirmed, 1}, true));
  EXPECT_TRUE(database_->rename(named, "Obj_50"));  // typed on purpose

  EXPECT_EQ(database_->merge(Ids{seen_more, oldest})->into, oldest) << "numbers stay what they were";
  EXPECT_EQ(database_->merge(Ids{oldest, confirmed})->into, confirmed);
  const ObjectMerge last = *database_->merge(Ids{confirmed, named});
  EXPECT_EQ(last.into, named);
  EXPECT_THAT(last.from, ElementsAre(confirmed));
  EXPECT_EQ(record(named).name, "Obj_50");
  EXPECT_EQ(record(named).views, 6);
  EXPECT_TRUE(record(named).confirmed) << "a person's mark is not lost";
}

TEST_F(ObjectMerging, UnmergeIsTheExactInverse) {
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
  EXPECT_EQ(record(b).size_m, Eigen::Vector3f(0.9F, 0.1F, 0.1F));  // most of the views say so
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

TEST_F(ObjectMerging, ViewsFollowTheirObjectsThroughMergesOfMerges) {
  const ObjectId a = add(), b = add(2), c = add(4);
  EXPECT_TRUE(database_->setConfirmed({&b, 1}, true));
  EXPECT_TRUE(database_->rename(c, "mug"));
  EXPECT_FALSE(database_->merge(Ids{a, a}));
  EXPECT_FALSE(database_->merge(Ids{a}));
  const ObjectMerge first = *database_->merge(Ids{a, b}), second = *database_->merge(Ids{b, c});
  EXPECT_EQ(database_->objects()->size(), 1U);
  EXPECT_EQ(record(c).views, 7);
  EXPECT_EQ(*database_->mergeRoot(a), c);
  ObjectView late = randomView(4);  // a scan that still follows `a`
  late.object = a;
  EXPECT_TRUE(database_->addView(late));
  EXPECT_EQ(record(c).views, 8);
  EXPECT_FALSE(database_->merge(Ids{c, a}));
  EXPECT_FALSE(database_->unmerge({c, {a}, false}));  // it was merged into b
  EXPECT_FALSE(database_->restore({&a, 1}));

  EXPECT_TRUE(database_->unmerge(second));  // b comes back with what it held of a
  EXPECT_EQ(record(c).views, 4);
  EXPECT_EQ(record(b).views, 4);
  EXPECT_EQ(*database_->mergeRoot(a), b);
  EXPECT_TRUE(database_->unmerge(first));
  EXPECT_EQ(record(a).views, 2);
  EXPECT_EQ(record(b).views, 2);
  EXPECT_TRUE(sameImage(database_->views().of(a)->front().color, randomView(0).color));
}

TEST_F(ObjectMerging, SizeAndPictureFollowTheViews) {
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
  addView({9.0F, 8.0F, 7.0F}, 50);  // one look went wrong
  EXPECT_EQ(record(id).size_m, Eigen::Vector3f(0.3F, 0.2F, 0.1F));
  addView({0, 0, 0}, 10);  // says nothing
  EXPECT_EQ(record(id).size_m, Eigen::Vector3f(0.3F, 0.2F, 0.1F));
  EXPECT_EQ(database_->views().picture(id)->size(), cv::Size(60, 60)) << "the look that shows most of it";
  const auto pictures = database_->views().pictures(id);
  ASSERT_TRUE(pictures);
  ASSERT_EQ(pictures->size(), 4U);
  EXPECT_EQ((*pictures)[0].size(), cv::Size(10, 10)) << "the newest first";
  EXPECT_EQ((*pictures)[2].size(), cv::Size(60, 60));
}

TEST_F(ObjectMerging, WhatIsPartedFromAPartLeavesItsHolderToo) {
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
      << "whoever keeps its record reads it anew";
  EXPECT_EQ(record(ids[0]).views, 2);
  EXPECT_EQ(record(ids[0]).size_m, small);
  const cv::Mat picture = *database_->views().picture(ids[0]);
  EXPECT_TRUE(std::ranges::any_of(*database_->views().pictures(ids[0]), [&](const cv::Mat& own) {
    return sameImage(own, picture);
  })) << "of its own views";
  ASSERT_TRUE(database_->unmerge(*second));
  EXPECT_EQ(visibleState(), before);
}

TEST_F(ObjectMerging, AnObjectOfUnknownSizeDoesNotKeepThatOfAnother) {
  const Ids ids{add(1, Eigen::Vector3f::Zero()), add(1)};
  const Result<ObjectMerge> merge = database_->merge(ids);
  ASSERT_TRUE(merge);
  ASSERT_EQ(merge->into, ids[0]);
  EXPECT_FALSE(record(ids[0]).size_m.isZero());
  ASSERT_TRUE(database_->unmerge(*merge));
  EXPECT_TRUE(record(ids[0]).size_m.isZero());
  EXPECT_FALSE(record(ids[1]).size_m.isZero());
}

TEST_F(ObjectMerging, WhatIsWithdrawnIsNothingThatAPersonKnows) {
  const Ids ids{add(), add(), add(), add(), add()};
  EXPECT_TRUE(database_->setConfirmed(Ids{ids[0]}, true));
  EXPECT_TRUE(database_->rename(ids[1], "mug"));
  ASSERT_TRUE(database_->merge(Ids{ids[2], ids[3]}));
  for (int i = 0; i < 4; ++i)
    EXPECT_FALSE(database_->withdraw(ids[static_cast<std::size_t>(i)]).value_or(true));
  EXPECT_EQ(database_->objects()->size(), 4U) << "others are part of the third";
  EXPECT_TRUE(database_->withdraw(ids[4]).value_or(false));
  EXPECT_FALSE(database_->withdraw(ids[4]).value_or(true)) << "once";
}

TEST_F(ObjectMerging, MergeRootsAreKnownForAllObjects) {
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

TEST_F(ObjectMerging, MergesInACircleOrIntoNothingEnd) {
  const Ids ids{add(), add(), add(), add()};
  askSqlite(file(), "UPDATE objects SET hidden = 1, merged_into = 2 WHERE id = 1");
  askSqlite(file(), "UPDATE objects SET hidden = 1, merged_into = 1 WHERE id = 2");
  askSqlite(file(), "UPDATE objects SET hidden = 1, merged_into = 77 WHERE id = 3");
  askSqlite(file(), "UPDATE objects SET merged_into = 4 WHERE id = 4");
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
}  // namespace scantrove
