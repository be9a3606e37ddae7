#include <gmock/gmock.h>

#include <QComboBox>

#include "tests/ui/window/window_fixture.h"
#include "ui/models/object_filter.h"
#include "ui/models/object_renamer.h"
#include "ui/panels/elided_label.h"
#include "ui/panels/object_filter_bar.h"

namespace scantrove {
namespace {

using testing::ElementsAre;

class ObjectFilterTest : public test::CatalogueTest {
 protected:
  using Shown = ObjectFilter::Shown;
  using Order = ObjectFilter::Order;

  void SetUp() override {
    CatalogueTest::SetUp();
    ASSERT_TRUE(editor_.open(file_));
    ASSERT_TRUE(renamer_.apply(objects_[0], QStringLiteral("seat/Red chair"), TypedName::Answer::another));
    ASSERT_TRUE(renamer_.apply(objects_[2], QStringLiteral("cup/Big mug"), TypedName::Answer::another));
    ASSERT_TRUE(editor_.setConfirmed({objects_[2]}, true));
  }
  [[nodiscard]] std::vector<ObjectId> shown() const {
    std::vector<ObjectId> objects;
    for (int row = 0; row < filter_.rowCount(); ++row)
      objects.push_back(filter_.objectAt(filter_.index(row, 0)));
    return objects;
  }

  UndoHistory history_;
  CatalogueEditor editor_{history_};
  ObjectRenamer renamer_{editor_};
  ObjectListModel model_{editor_};
  ObjectFilter filter_{model_};
};

TEST_F(ObjectFilterTest, FindsNamesAndClasses_WhateverTheCase) {
  filter_.setSearch(QStringLiteral("CHAIR"));
  EXPECT_THAT(shown(), ElementsAre(objects_[0]));
  filter_.setSearch(QStringLiteral("cup"));
  EXPECT_THAT(shown(), ElementsAre(objects_[2])) << "the class";
  filter_.setSearch(QStringLiteral("mug big"));
  EXPECT_THAT(shown(), ElementsAre(objects_[2])) << "each word";
  filter_.setSearch(QStringLiteral("obj"));
  EXPECT_THAT(shown(), ElementsAre(objects_[1]));
  filter_.setSearch({});
  EXPECT_EQ(shown().size(), 3U);
}

TEST_F(ObjectFilterTest, ShowsKindsOfObjects) {
  filter_.setShown(Shown::named);
  EXPECT_THAT(shown(), ElementsAre(objects_[0], objects_[2]));
  EXPECT_EQ(filter_.namedCount(), 2);
  filter_.setShown(Shown::confirmed);
  EXPECT_THAT(shown(), ElementsAre(objects_[2]));
  filter_.setShown(Shown::without_name);
  EXPECT_THAT(shown(), ElementsAre(objects_[1]));
  filter_.setShown(Shown::of_class, editor_.catalogue().classes().named("seat")->id);
  EXPECT_THAT(shown(), ElementsAre(objects_[0]));
  filter_.setShown(Shown::of_class);
  EXPECT_THAT(shown(), ElementsAre(objects_[1])) << "no class";
}

TEST_F(ObjectFilterTest, FollowsTheFrame) {
  filter_.setShown(Shown::in_view);
  EXPECT_TRUE(shown().empty());
  SeenObject seen;
  seen.object = objects_[1];
  model_.setInView({seen});
  EXPECT_THAT(shown(), ElementsAre(objects_[1]));
  model_.setInView({});
  EXPECT_TRUE(shown().empty());
  filter_.setShown(Shown::in_scan);
  model_.markAdded(objects_[2]);
  EXPECT_THAT(shown(), ElementsAre(objects_[2]));
}

TEST_F(ObjectFilterTest, Sorts_AndKeepsTheOrderAfterARename) {
  filter_.setOrder(Order::name);
  EXPECT_THAT(shown(), ElementsAre(objects_[2], objects_[1], objects_[0]));
  ASSERT_TRUE(editor_.rename(objects_[1], QStringLiteral("Zebra")));
  EXPECT_THAT(shown(), ElementsAre(objects_[2], objects_[0], objects_[1]));
  filter_.setOrder(Order::object_class);
  EXPECT_THAT(shown(), ElementsAre(objects_[2], objects_[0], objects_[1])) << "without class last";
  filter_.setOrder(Order::newest);
  EXPECT_THAT(shown(), ElementsAre(objects_[2], objects_[1], objects_[0]));
  filter_.setOrder(Order::oldest);
  EXPECT_THAT(shown(), ElementsAre(objects_[0], objects_[1], objects_[2]));
}

TEST_F(ObjectFilterTest, SortsNumbersByTheirValue) {
  ASSERT_TRUE(editor_.rename(objects_[0], QStringLiteral("Chair 10")));
  ASSERT_TRUE(editor_.rename(objects_[1], QStringLiteral("chair 9")));
  ASSERT_TRUE(editor_.rename(objects_[2], QStringLiteral("chair 2")));
  filter_.setOrder(Order::name);
  EXPECT_THAT(shown(), ElementsAre(objects_[2], objects_[1], objects_[0]));
}

TEST_F(ObjectFilterTest, SortsAccentsBesideTheirLetters) {
  ASSERT_TRUE(editor_.rename(objects_[0], QStringLiteral("zebra")));
  ASSERT_TRUE(editor_.rename(objects_[1], QString::fromUtf8("\u00e9tag\u00e8re")));
  ASSERT_TRUE(editor_.rename(objects_[2], QStringLiteral("bowl")));
  filter_.setOrder(Order::name);
  EXPECT_THAT(shown(), ElementsAre(objects_[2], objects_[1], objects_[0])) << "bytes would put z before e";
}

TEST_F(ObjectFilterTest, OnlyUnnamedObjectsAreNew) {
  for (const ObjectId object : objects_) model_.markAdded(object);
  EXPECT_FALSE(model_.indexOf(objects_[0]).data(ObjectListModel::AddedNowRole).toBool());
  EXPECT_TRUE(model_.indexOf(objects_[1]).data(ObjectListModel::AddedNowRole).toBool());
  EXPECT_EQ(model_.indexOf(objects_[0]).data(ObjectListModel::ClassNameRole).toString(),
            QStringLiteral("seat"));
}

TEST_F(ObjectFilterTest, EntriesCountTheirObjects) {
  ObjectFilterBar bar(model_, filter_);
  QStringList entries;
  for (int i = 0; i < bar.shown()->count(); ++i) entries << bar.shown()->itemText(i);
  EXPECT_TRUE(entries.contains(QStringLiteral("All (3)")));
  EXPECT_TRUE(entries.contains(QStringLiteral("Not yet named (1)")));
  EXPECT_TRUE(entries.contains(QStringLiteral("seat (1)")));
  EXPECT_TRUE(entries.contains(QStringLiteral("No class (1)")));
}

using ObjectSearchTest = test::WindowTest;

TEST_F(ObjectSearchTest, CtrlFFindsAnObject_AndReturnGoesToTheList) {
  QTest::keyClick(window_.get(), Qt::Key_F, Qt::ControlModifier);
  QLineEdit* const search = window_->parts().objects->filterBar()->search();
  ASSERT_TRUE(search->hasFocus());
  QTest::keyClicks(search, QStringLiteral("_2"));
  EXPECT_EQ(list()->model()->rowCount(), 1);
  QTest::keyClick(search, Qt::Key_Return);
  EXPECT_TRUE(list()->hasFocus());
  EXPECT_EQ(list()->selection(), std::vector{objects_[1]});
  search->clear();
  EXPECT_EQ(list()->model()->rowCount(), 3);
  EXPECT_EQ(list()->selection(), std::vector{objects_[1]});
}

TEST_F(ObjectSearchTest, LineCountsNamedObjects) {
  ASSERT_TRUE(window_->editor().rename(objects_[1], QStringLiteral("cup")));
  EXPECT_TRUE(window_->parts().objects->countLabel()->fullText().startsWith(QStringLiteral("1 of 3 named")));
}

}  // namespace
}  // namespace scantrove
