// Naming a second thing of a class: the window asks whether it is the same one.
#include <gtest/gtest.h>

#include <QAbstractItemView>
#include <QCompleter>
#include <QPushButton>

#include "tests/ui/window/pointing_fixture.h"
#include "ui/models/object_renamer.h"
#include "ui/models/region_names.h"
#include "ui/panels/name_editor.h"
#include "ui/panels/same_name_choice.h"

namespace scantrove::test {
namespace {

class NamingTest : public PointingTest {
 protected:
  /// Types a name for region 5. Region 7 is called "red cup" and no object of the catalogue yet.
  void type(const QString& name) {
    clickPicture(0, 0.2);
    QTest::keyClick(panel(0), Qt::Key_Return);
    QTest::keyClicks(nameField(), name);
  }
  SameNameChoice* choice() { return window_->regions().nameEditor().choice(); }
};

TEST_F(NamingTest, ReturnNamesWhatIsPointedAt_WhenNothingIsSelected) {
  ASSERT_TRUE(QTest::qWaitFor([&] { return !pixelInScene(RegionId{7}).isNull(); }, kPatience_ms));
  ASSERT_TRUE(hoverOver(0, {0.8, 0.3}, RegionId{7}));
  ASSERT_TRUE(selection().selected().empty());
  QTest::keyClick(panel(0), Qt::Key_Return);
  EXPECT_EQ(selection().selected(), std::vector{RegionId{7}});
  QTest::keyClicks(nameField(), QStringLiteral("hammer"));
  QTest::keyClick(nameField(), Qt::Key_Return);
  ASSERT_NE(lastOperation(), nullptr);
  EXPECT_EQ(lastOperation()->name, "hammer");
}

TEST_F(NamingTest, NameIsCompletedToAClass) {
  type(QStringLiteral("hammer"));
  EXPECT_FALSE(choice()->isAsking());
  QTest::keyClick(nameField(), Qt::Key_Return);
  ASSERT_NE(lastOperation(), nullptr);
  EXPECT_EQ(lastOperation()->name, "hammer");
  EXPECT_EQ(lastOperation()->category, "hammer") << "a new class";
}

TEST_F(NamingTest, ReturnNamesAnotherThing_WhenTheNameIsTaken) {
  type(QStringLiteral("red cup"));
  ASSERT_TRUE(choice()->isAsking());
  QTest::qWait(50);
  EXPECT_FALSE(nameField()->completer()->popup()->isVisible()) << "it would cover the answers";
  EXPECT_TRUE(choice()->button(TypedName::Answer::another)->text().contains(QStringLiteral("red cup 2")));
  QTest::keyClick(nameField(), Qt::Key_Return);
  ASSERT_NE(lastOperation(), nullptr);
  EXPECT_EQ(lastOperation()->name, "red cup 2");
  EXPECT_EQ(lastOperation()->category, "cup") << "the class of the other one";
}

TEST_F(NamingTest, ShiftReturnNamesTheSameThing) {
  type(QStringLiteral("red cup"));
  QTest::keyClick(nameField(), Qt::Key_Return, Qt::ShiftModifier);
  ASSERT_NE(lastOperation(), nullptr);
  EXPECT_EQ(lastOperation()->name, "red cup");
  EXPECT_EQ(lastOperation()->regions, std::vector{RegionId{5}});
}

TEST_F(NamingTest, TabAndArrowsChooseAnAnswer) {
  type(QStringLiteral("red cup"));
  QTest::keyClick(nameField(), Qt::Key_Tab);
  ASSERT_TRUE(choice()->holdsFocus());
  EXPECT_TRUE(worker_->edits.empty()) << "the field has not been left";
  QTest::keyClick(choice()->button(TypedName::Answer::another), Qt::Key_Down);
  QTest::keyClick(choice()->button(TypedName::Answer::same), Qt::Key_Return);
  ASSERT_NE(lastOperation(), nullptr);
  EXPECT_EQ(lastOperation()->name, "red cup");
  EXPECT_FALSE(nameField()->isVisible());
}

TEST_F(NamingTest, ListMergesTwoObjects_OnlyWhenToldThatTheyAreTheSame) {
  ASSERT_TRUE(window_->editor().rename(objects_[0], QStringLiteral("chair")));
  const auto rename = [this](Qt::KeyboardModifiers modifiers) {
    clickOn(objects_[1]);
    QTest::keyClick(list(), Qt::Key_F2);
    ASSERT_NE(nameEditor(), nullptr);
    QTest::keyClicks(nameEditor(), QStringLiteral("chair"));
    EXPECT_TRUE(list()->nameEditor()->choice()->isAsking());
    QTest::keyClick(nameEditor(), Qt::Key_Return, modifiers);
  };
  rename({});
  EXPECT_EQ(storedCount(), 3U);
  EXPECT_EQ(stored(objects_[1]).name, "chair 2");
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(stored(objects_[1]).name, "Obj_2");
  rename(Qt::ShiftModifier);
  EXPECT_EQ(storedCount(), 2U);
  EXPECT_EQ(stored(objects_[0]).name, "chair");
  EXPECT_EQ(stored(objects_[0]).views, 2);
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(storedCount(), 3U);
  EXPECT_EQ(stored(objects_[1]).name, "Obj_2");
}

class ObjectRenamerTest : public CatalogueTest {
 protected:
  void SetUp() override {
    CatalogueTest::SetUp();
    ASSERT_TRUE(editor_.open(file_));
  }
  UndoHistory history_;
  CatalogueEditor editor_{history_};
  ObjectRenamer renamer_{editor_};
};

TEST_F(ObjectRenamerTest, GivesNameAndClass_AndUndoTakesBothBack) {
  ASSERT_TRUE(renamer_.apply(objects_[0], QStringLiteral("seat/red chair"), TypedName::Answer::another));
  EXPECT_EQ(stored(objects_[0]).name, "red chair");
  const ClassId seat = stored(objects_[0]).classification.class_id;
  ASSERT_NE(editor_.catalogue().classes().named("seat"), nullptr);
  EXPECT_EQ(editor_.catalogue().classes().named("seat")->id, seat);
  history_.stack().undo();
  EXPECT_EQ(stored(objects_[0]).name, "Obj_1");
  EXPECT_FALSE(stored(objects_[0]).classification.class_id);
  EXPECT_EQ(editor_.catalogue().classes().named("seat"), nullptr) << "nothing has the class";
  history_.stack().redo();
  EXPECT_EQ(stored(objects_[0]).name, "red chair");
  EXPECT_EQ(stored(objects_[0]).classification.class_id, seat) << "the class has its id again";
}

TEST_F(ObjectRenamerTest, MergedObjectIsCalledAsTyped_WhenUsersNamedBoth) {
  ASSERT_TRUE(editor_.rename(objects_[0], QStringLiteral("stool")));
  ASSERT_TRUE(editor_.rename(objects_[1], QStringLiteral("chair")));
  ASSERT_TRUE(renamer_.apply(objects_[0], QStringLiteral("chair"), TypedName::Answer::same));
  EXPECT_EQ(storedCount(), 2U);
  EXPECT_EQ(stored(objects_[0]).name, "chair") << "the older one remains, with the typed name";
  history_.stack().undo();
  EXPECT_EQ(stored(objects_[0]).name, "stool");
  EXPECT_EQ(stored(objects_[1]).name, "chair");
}

TEST(RegionNames, SeveralRegionsAreDifferentThings_UnlessToldOtherwise) {
  RegionSelection selection;
  RegionNames names(selection);
  names.begin(CatalogueModel(), {RegionId{1}, RegionId{2}, RegionId{3}});
  const auto completion = names.complete(QStringLiteral("chair"));
  ASSERT_TRUE(completion);
  EXPECT_TRUE(completion->typed.is_taken);
  ASSERT_EQ(completion->another.size(), 3U);
  EXPECT_EQ(completion->another[0].given, (GivenName{"chair", "chair"}));
  EXPECT_EQ(completion->another[1].given, (GivenName{"chair 2", "chair"}));
  EXPECT_EQ(completion->another[2].given, (GivenName{"chair 3", "chair"}));
  for (const RegionName& name : completion->same) EXPECT_EQ(name.given.name, "chair");
}

TEST(RegionNames, NameThatWasJustGivenIsTaken_UntilTheScanTellsIt) {
  RegionSelection selection;
  RegionNames names(selection);
  names.noteGiven({RegionId{1}, {"chair", "seat"}});
  names.begin(CatalogueModel(), {RegionId{2}});
  const auto completion = names.complete(QStringLiteral("chair"));
  ASSERT_TRUE(completion);
  EXPECT_TRUE(completion->typed.is_taken);
  EXPECT_EQ(completion->another[0].given, (GivenName{"chair 2", "seat"}));
  Operation done;
  done.kind = OperationKind::name;
  done.regions = {RegionId{1}};
  done.name = "chair";
  names.noteDone(done);
  names.noteUpdated();  // the selection has nothing of it: the name was undone
  names.begin(CatalogueModel(), {RegionId{2}});
  EXPECT_FALSE(names.complete(QStringLiteral("chair"))->typed.is_taken);
}

}  // namespace
}  // namespace scantrove::test
