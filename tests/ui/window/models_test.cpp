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
  UndoHistory history_;
  CatalogueEditor editor_{history_};
};

TEST_F(CatalogueEditorTest, RenameIsStoredAndUndone) {
  ASSERT_TRUE(editor_.rename(objects_[1], QStringLiteral("  Green cup ")));
  EXPECT_EQ(stored(objects_[1]).name, "Green cup");
  history_.stack().undo();
  EXPECT_EQ(stored(objects_[1]).name, "Obj_2");
  history_.stack().redo();
  EXPECT_EQ(stored(objects_[1]).name, "Green cup");
}

TEST_F(CatalogueEditorTest, RefusedRenameIsReported_AndIsNoUndoStep) {
  QSignalSpy failures(&editor_, &CatalogueEditor::failed);
  EXPECT_FALSE(editor_.rename(objects_[1], QStringLiteral("Obj_1")));
  EXPECT_FALSE(editor_.rename(objects_[1], QStringLiteral("   ")));
  EXPECT_EQ(failures.count(), 2);
  EXPECT_FALSE(history_.stack().canUndo());
  EXPECT_EQ(stored(objects_[1]).name, "Obj_2");
}

TEST_F(CatalogueEditorTest, DeletesMergesAndConfirmsSeveralInOneStep) {
  QUndoStack& undo = history_.stack();
  ASSERT_TRUE(editor_.remove({objects_[0], objects_[2]}));
  EXPECT_EQ(storedCount(), 1U);
  undo.undo();
  EXPECT_EQ(storedCount(), 3U);

  ASSERT_TRUE(editor_.rename(objects_[1], QStringLiteral("Cup")));
  ASSERT_TRUE(editor_.merge(objects_));
  EXPECT_EQ(storedCount(), 1U);
  EXPECT_EQ(stored(objects_[1]).views, 3);
  EXPECT_EQ(stored(objects_[1]).name, "Cup");
  undo.undo();
  EXPECT_EQ(storedCount(), 3U);
  EXPECT_EQ(stored(objects_[1]).views, 1);
  EXPECT_EQ(stored(objects_[2]).name, "Obj_3");
  undo.redo();
  EXPECT_EQ(stored(objects_[1]).views, 3);
  undo.undo();

  // Undo restores the state of each object.
  ASSERT_TRUE(editor_.setConfirmed({objects_[2]}, true));
  const int steps = undo.index();
  ASSERT_TRUE(editor_.setConfirmed(objects_, true));
  EXPECT_EQ(undo.index(), steps + 1);
  for (const ObjectId object : objects_) EXPECT_TRUE(stored(object).confirmed);
  undo.undo();
  EXPECT_FALSE(stored(objects_[0]).confirmed);
  EXPECT_FALSE(stored(objects_[1]).confirmed);
  EXPECT_TRUE(stored(objects_[2]).confirmed);
}

TEST_F(CatalogueEditorTest, UndoneRenameIsNoNameByAUser) {
  ASSERT_TRUE(editor_.rename(objects_[1], QStringLiteral("Cup")));
  EXPECT_EQ(stored(objects_[1]).named_by, NamedBy::user);
  history_.stack().undo();
  EXPECT_EQ(stored(objects_[1]).named_by, NamedBy::program);
}

TEST_F(CatalogueEditorTest, ReportsChangesByOthersOnce) {
  auto other = ObjectDatabase::open(file_.toStdString());
  ASSERT_TRUE(other);
  QSignalSpy changes(&editor_, &CatalogueEditor::changed);
  editor_.poll();
  EXPECT_EQ(changes.count(), 0);
  ASSERT_TRUE((*other)->rename(objects_[1], "Cup"));
  editor_.poll();
  editor_.poll();
  ASSERT_EQ(changes.count(), 1);
  const auto reported = changes[0][0].value<CatalogueChanges>();
  ASSERT_EQ(reported.changes.size(), 1U);
  EXPECT_EQ(reported.changes[0].object(), objects_[1]);
}

TEST_F(CatalogueEditorTest, KeepsTheOpenCatalogue_WhenAnotherCannotBeOpened) {
  const Result<void> opened = editor_.open(QStringLiteral("/proc/scantrove/none.sqlite"));
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().message().find("/proc/scantrove"), std::string::npos);
  EXPECT_EQ(editor_.objects().size(), 3U);
}

TEST_F(CatalogueEditorTest, ModelListsNewestLast_WithPictures) {
  ObjectListModel model(editor_);
  ASSERT_EQ(model.rowCount(), 3);
  EXPECT_EQ(model.objectAt(model.index(2)), objects_[2]);
  const auto picture = model.index(2).data(Qt::DecorationRole).value<QImage>();
  ASSERT_FALSE(picture.isNull());
  const QColor center = picture.pixelColor(picture.width() / 2, picture.height() / 2);
  EXPECT_GT(center.blue(), 200);
  EXPECT_LT(center.red(), 60);
}

TEST_F(CatalogueEditorTest, ModelFollowsTheDatabaseRowByRow) {
  ObjectListModel model(editor_);
  QSignalSpy resets(&model, &QAbstractItemModel::modelReset);
  QSignalSpy rows(&model, &QAbstractItemModel::dataChanged);
  const QPersistentModelIndex last(model.indexOf(objects_[2]));
  auto other = ObjectDatabase::open(file_.toStdString());
  ASSERT_TRUE(other);
  const auto added = (*other)->addObject(test::discView({0, 255, 255}));
  ASSERT_TRUE(added);
  editor_.poll();
  ASSERT_EQ(model.rowCount(), 4);
  EXPECT_EQ(model.objectAt(model.index(3)), added->id);
  EXPECT_EQ(rows.count(), 0);

  ASSERT_TRUE((*other)->setConfirmed(std::vector{objects_[1]}, true));
  editor_.poll();
  ASSERT_EQ(rows.count(), 1);
  EXPECT_EQ(rows[0][0].toModelIndex(), model.indexOf(objects_[1]));
  EXPECT_EQ(rows[0][1].toModelIndex(), model.indexOf(objects_[1]));
  EXPECT_EQ(model.confirmedCount(), 1);

  ASSERT_TRUE((*other)->remove(std::vector{objects_[1]}));
  editor_.poll();
  EXPECT_EQ(model.rowCount(), 3);
  EXPECT_EQ(model.confirmedCount(), 0);
  EXPECT_EQ(model.objectAt(last), objects_[2]);
  ASSERT_TRUE((*other)->restore(std::vector{objects_[1]}));
  editor_.poll();
  EXPECT_EQ(model.objectAt(model.index(1)), objects_[1]);
  EXPECT_EQ(resets.count(), 0);
}

TEST_F(CatalogueEditorTest, ModelSignalsAMerge_WhileBothRowsExist) {
  ObjectListModel model(editor_);
  int merges = 0;
  QObject::connect(&model, &ObjectListModel::merged, [&](ObjectId into, ObjectId from) {
    ++merges;
    EXPECT_TRUE(model.indexOf(into).isValid());
    EXPECT_TRUE(model.indexOf(from).isValid());
    EXPECT_EQ(into, objects_[1]);
  });
  ASSERT_TRUE(editor_.rename(objects_[1], QStringLiteral("Cup")));
  ASSERT_TRUE(editor_.merge({objects_[0], objects_[1]}));
  EXPECT_EQ(merges, 1);
  EXPECT_EQ(model.rowCount(), 2);
  EXPECT_EQ(model.record(objects_[1])->views, 2);
  history_.stack().undo();
  EXPECT_EQ(merges, 1);
  EXPECT_EQ(model.rowCount(), 3);
}

TEST_F(CatalogueEditorTest, ModelMarksObjectsInView) {
  ObjectListModel model(editor_);
  SeenObject seen;
  seen.object = objects_[1];
  model.setInView({seen});
  EXPECT_TRUE(model.indexOf(objects_[1]).data(ObjectListModel::InViewRole).toBool());
  EXPECT_FALSE(model.indexOf(objects_[0]).data(ObjectListModel::InViewRole).toBool());
}

}  // namespace
}  // namespace scantrove
