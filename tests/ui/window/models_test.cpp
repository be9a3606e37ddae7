#include <QSignalSpy>

#include "tests/ui/window/catalogue_fixture.h"
#include "ui/models/object_list_model.h"

namespace scantrove {
namespace {

class CatalogueEditorTest : public test::CatalogueTest {
 protected:
  void SetUp() override {
    CatalogueTest::SetUp();
    ASSERT_TRUE(editor_.open(file_));
  }
  CatalogueEditor editor_;
};

TEST_F(CatalogueEditorTest, RenameIsStoredAtOnceAndUndone) {
  ASSERT_TRUE(editor_.rename(objects_[1], QStringLiteral("  Green cup ")));
  EXPECT_EQ(stored(objects_[1]).name, "Green cup");
  editor_.undoStack().undo();
  EXPECT_EQ(stored(objects_[1]).name, "Obj_2");
  editor_.undoStack().redo();
  EXPECT_EQ(stored(objects_[1]).name, "Green cup");
}

TEST_F(CatalogueEditorTest, RefusedRenameIsAnnouncedAndLeavesNothingToUndo) {
  QSignalSpy failures(&editor_, &CatalogueEditor::failed);
  EXPECT_FALSE(editor_.rename(objects_[1], QStringLiteral("Obj_1")));
  EXPECT_FALSE(editor_.rename(objects_[1], QStringLiteral("   ")));
  EXPECT_EQ(failures.count(), 2);
  EXPECT_FALSE(editor_.undoStack().canUndo());
  EXPECT_EQ(stored(objects_[1]).name, "Obj_2");
}

TEST_F(CatalogueEditorTest, DeleteAndMergeAreUndone) {
  ASSERT_TRUE(editor_.remove({objects_[0], objects_[2]}));
  EXPECT_EQ(storedCount(), 1U);
  editor_.undoStack().undo();
  EXPECT_EQ(storedCount(), 3U);
  ASSERT_TRUE(editor_.merge(objects_));
  EXPECT_EQ(storedCount(), 1U);
  EXPECT_EQ(stored(objects_[0]).views, 3);
  editor_.undoStack().undo();
  EXPECT_EQ(storedCount(), 3U);
  EXPECT_EQ(stored(objects_[0]).views, 1);
  EXPECT_EQ(stored(objects_[2]).name, "Obj_3");
}

TEST_F(CatalogueEditorTest, KeepsTheOpenCatalogueWhenAnotherCannotBeOpened) {
  const Result<void> opened = editor_.open(QStringLiteral("/proc/scantrove/none.sqlite"));
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().message().find("/proc/scantrove"), std::string::npos);
  EXPECT_EQ(editor_.objects().size(), 3U);
}

TEST_F(CatalogueEditorTest, ModelListsNewestFirstWithPictures) {
  ObjectListModel model(editor_);
  ASSERT_EQ(model.rowCount(), 3);
  EXPECT_EQ(model.objectAt(model.index(0)), objects_[2]);
  const auto picture = model.index(0).data(Qt::DecorationRole).value<QImage>();
  ASSERT_FALSE(picture.isNull());
  const QColor centre = picture.pixelColor(picture.width() / 2, picture.height() / 2);
  EXPECT_GT(centre.blue(), 200);
  EXPECT_LT(centre.red(), 60);
}

TEST(ViewPicture, DimsWhatIsNotTheObject) {
  const QImage picture = viewPicture(test::discView({0, 0, 255}));
  EXPECT_EQ(picture.pixelColor(40, 30), QColor(255, 0, 0));
  EXPECT_LT(picture.pixelColor(1, 1).lightness(), 80);
  EXPECT_TRUE(viewPicture(ObjectView{}).isNull());
}

TEST_F(CatalogueEditorTest, ModelFollowsTheDatabaseRowByRow) {
  ObjectListModel model(editor_);
  QSignalSpy resets(&model, &QAbstractItemModel::modelReset);
  const QPersistentModelIndex first(model.indexOf(objects_[0]));
  auto other = ObjectDatabase::open(file_.toStdString());
  ASSERT_TRUE(other);
  ASSERT_TRUE((*other)->addObject(test::discView({0, 255, 255})));
  model.markAdded(ObjectId{objects_[2].value + 1});
  EXPECT_EQ(model.rowCount(), 4);
  ASSERT_TRUE((*other)->remove({&objects_[1], 1}));
  model.reload();
  EXPECT_EQ(model.rowCount(), 3);
  EXPECT_EQ(model.objectAt(first), objects_[0]);
  EXPECT_EQ(resets.count(), 0);
}

TEST_F(CatalogueEditorTest, ModelKnowsWhatIsInView) {
  ObjectListModel model(editor_);
  SeenObject seen;
  seen.object = objects_[1];
  model.setInView({seen});
  EXPECT_TRUE(model.indexOf(objects_[1]).data(ObjectListModel::InViewRole).toBool());
  EXPECT_FALSE(model.indexOf(objects_[0]).data(ObjectListModel::InViewRole).toBool());
}

}  // namespace
}  // namespace scantrove
