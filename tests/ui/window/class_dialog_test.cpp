#include <gtest/gtest.h>

#include <QFile>
#include <QLineEdit>
#include <QTableWidget>

#include "tests/ui/window/window_fixture.h"
#include "ui/main_window/window_dialogs.h"
#include "ui/models/attribute_text.h"
#include "ui/models/class_editor.h"
#include "ui/models/object_renamer.h"
#include "ui/panels/class_dialog.h"

namespace scantrove {
namespace {

class ClassEditorTest : public test::CatalogueTest {
 protected:
  void SetUp() override {
    CatalogueTest::SetUp();
    ASSERT_TRUE(editor_.open(file_));
    ASSERT_TRUE(renamer_.apply(objects_[0], QStringLiteral("seat/chair"), TypedName::Answer::another));
    ASSERT_TRUE(renamer_.apply(objects_[1], QStringLiteral("stool/low one"), TypedName::Answer::another));
  }
  [[nodiscard]] ClassId idOf(const std::string& name) {
    const CatalogueModel catalogue = editor_.catalogue();
    const ObjectClass* known = catalogue.classes().named(name);
    return known != nullptr ? known->id : ClassId{};
  }
  void undo() { history_.stack().undo(); }

  UndoHistory history_;
  CatalogueEditor editor_{history_};
  ObjectRenamer renamer_{editor_};
  ClassEditor classes_{editor_};
};

TEST_F(ClassEditorTest, ListsClassesWithTheirObjects) {
  const std::vector<ListedClass> list = classes_.classes();
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].object_class.name, "seat");
  EXPECT_EQ(list[0].objects, 1);
}

TEST_F(ClassEditorTest, RenameAndMergeAreUndone) {
  const ClassId seat = idOf("seat"), stool = idOf("stool");
  ASSERT_TRUE(classes_.edit({.id = seat, .name = "chairs"}));
  EXPECT_EQ(idOf("chairs"), seat);
  ASSERT_TRUE(classes_.merge({stool}, seat));
  ASSERT_EQ(classes_.classes().size(), 1U);
  EXPECT_EQ(classes_.classes()[0].objects, 2);
  undo();
  EXPECT_EQ(classes_.classes().size(), 2U);
  undo();
  EXPECT_EQ(idOf("seat"), seat);
  EXPECT_FALSE(idOf("chairs"));
}

TEST_F(ClassEditorTest, UndoneEditLeavesWhatOthersEditedSince) {
  const ClassId seat = idOf("seat");
  ASSERT_TRUE(classes_.edit({.id = seat, .name = "chairs"}));
  const auto others = ObjectDatabase::open(file_.toStdString());
  ASSERT_TRUE(others);
  ASSERT_TRUE((*others)->classes().edit({.id = seat, .supercategory = "furniture"}));
  undo();
  EXPECT_EQ(idOf("seat"), seat);
  const CatalogueModel catalogue = editor_.catalogue();
  EXPECT_EQ(catalogue.classes().find(seat)->supercategory, "furniture");
}

TEST_F(ClassEditorTest, UsedClassIsNotDeleted) {
  QString message;
  QObject::connect(&editor_, &CatalogueEditor::failed, [&](const QString& text) { message = text; });
  EXPECT_FALSE(classes_.hide({idOf("seat")}));
  EXPECT_TRUE(message.contains(QStringLiteral("seat")));
  ASSERT_TRUE(classes_.add(QStringLiteral("lamp")));
  ASSERT_TRUE(classes_.hide({idOf("lamp")}));
  EXPECT_FALSE(idOf("lamp"));
  undo();
  EXPECT_TRUE(idOf("lamp"));
}

TEST_F(ClassEditorTest, ImportIsOneStep_AndItsUndoRestoresAll) {
  const QString list = folder_.filePath(QStringLiteral("list.csv"));
  QFile file(list);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write("id,name,supercategory,color\n,seat,furniture,#102030\n77,lamp,,\n");
  file.close();
  const std::vector<ListedClass> before = classes_.classes();
  const int steps = history_.stack().count();
  const std::optional<ClassImport> imported = classes_.importFrom(list);
  ASSERT_TRUE(imported);
  EXPECT_EQ(imported->added, 1);
  EXPECT_EQ(imported->updated, 1);
  EXPECT_EQ(idOf("lamp"), ClassId{77});
  EXPECT_EQ(history_.stack().count(), steps + 1);
  undo();
  const std::vector<ListedClass> after = classes_.classes();
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) EXPECT_EQ(after[i].object_class, before[i].object_class);
  history_.stack().redo();
  EXPECT_EQ(idOf("lamp"), ClassId{77}) << "with its id";
}

TEST_F(ClassEditorTest, UndoneImportLeavesWhatOthersDidSince) {
  const QString list = folder_.filePath(QStringLiteral("list.csv"));
  QFile file(list);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write("id,name,supercategory,color\n,seat,furniture,\n77,lamp,,\n78,vase,,\n");
  file.close();
  ASSERT_TRUE(classes_.importFrom(list));
  const auto others = ObjectDatabase::open(file_.toStdString());
  ASSERT_TRUE(others);
  ASSERT_TRUE((*others)->classes().add({.name = "desk"}));
  ASSERT_TRUE((*others)->classes().edit({.id = ClassId{77}, .name = "lantern"}));
  undo();
  EXPECT_TRUE(idOf("desk"));
  EXPECT_EQ(idOf("lantern"), ClassId{77});
  EXPECT_FALSE(idOf("vase"));
  const CatalogueModel catalogue = editor_.catalogue();
  EXPECT_TRUE(catalogue.classes().named("seat")->supercategory.empty());
}

TEST_F(ClassEditorTest, ExportReplacesNoFile) {
  const QString list = folder_.filePath(QStringLiteral("classes.json"));
  ASSERT_TRUE(classes_.exportTo(list));
  EXPECT_FALSE(classes_.exportTo(list)) << "the file exists";
  EXPECT_TRUE(classes_.importFrom(list)) << "it can be read again";
}

TEST(AttributeText, IsReadAsItWasWritten) {
  const std::vector<ClassAttribute> attributes{{"material", AttributeKind::choice, {"wood", "steel"}},
                                               {"broken", AttributeKind::yes_no},
                                               {"remark", AttributeKind::text}};
  const QString text = attributesToText(attributes);
  EXPECT_EQ(text, QStringLiteral("material: wood, steel; broken: yes/no; remark"));
  const auto read = attributesFromText(text);
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, attributes);
  EXPECT_FALSE(attributesFromText(QStringLiteral("wood; : steel")));
  EXPECT_TRUE(attributesFromText({})->empty());
}

class ClassDialogTest : public test::WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    ClassEditor classes(window_->editor());
    ASSERT_TRUE(classes.add(QStringLiteral("seat")));
    ASSERT_TRUE(classes.add(QStringLiteral("stool")));
    QTest::keyClick(window_.get(), Qt::Key_L, Qt::ControlModifier | Qt::ShiftModifier);
    ASSERT_NE(dialog(), nullptr);
    ASSERT_TRUE(dialog()->isVisible());
  }
  ClassDialog* dialog() { return window_->dialogs().classDialog(); }
  QString textAt(int row, int column) { return dialog()->table()->item(row, column)->text(); }
};

TEST_F(ClassDialogTest, CellsAreEditedInPlace) {
  ASSERT_EQ(dialog()->table()->rowCount(), 2);
  dialog()->table()->item(0, ClassDialog::kName)->setText(QStringLiteral("chair"));
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return window_->editor().catalogue().classes().named("chair") != nullptr; }, 3000));
  dialog()->table()->item(0, ClassDialog::kAttributes)->setText(QStringLiteral("broken: yes/no"));
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return !window_->editor().catalogue().classes().named("chair")->attributes.empty(); }, 3000));
  window_->history().stack().undo();
  window_->history().stack().undo();
  EXPECT_TRUE(QTest::qWaitFor([&] { return textAt(0, ClassDialog::kName) == QStringLiteral("seat"); }, 3000));
}

TEST_F(ClassDialogTest, RefusedNameGoesBack_AndIsExplained) {
  dialog()->table()->item(0, ClassDialog::kName)->setText(QStringLiteral("stool"));
  EXPECT_TRUE(QTest::qWaitFor(
      [&] {
        return dialog()->message().contains(QStringLiteral("stool")) &&
               textAt(0, ClassDialog::kName) == QStringLiteral("seat");
      },
      3000));
}

TEST_F(ClassDialogTest, TypedTextStaysWithItsClass_WhenOthersDeleteOne) {
  const auto idOf = [this](const char* name) {
    const CatalogueModel catalogue = window_->editor().catalogue();
    const ObjectClass* known = catalogue.classes().named(name);
    return known != nullptr ? known->id : ClassId{};
  };
  const ClassId stool = idOf("stool");
  ASSERT_EQ(textAt(1, ClassDialog::kName), QStringLiteral("stool"));
  dialog()->table()->editItem(dialog()->table()->item(1, ClassDialog::kName));
  auto* const field = dialog()->table()->findChild<QLineEdit*>();
  ASSERT_NE(field, nullptr);
  ASSERT_TRUE(ClassEditor(window_->editor()).hide({idOf("seat")}));
  QTest::qWait(500);
  field->setText(QStringLiteral("bench"));
  QTest::keyClick(field, Qt::Key_Return);
  EXPECT_TRUE(QTest::qWaitFor([&] { return idOf("bench") == stool; }, 3000));
  EXPECT_TRUE(QTest::qWaitFor([&] { return dialog()->table()->rowCount() == 1; }, 3000));
}

TEST_F(ClassDialogTest, SelectedClassesMerge) {
  dialog()->table()->selectAll();
  ASSERT_EQ(dialog()->selection().size(), 2U);
  dialog()->mergeSelected();
  EXPECT_TRUE(QTest::qWaitFor([&] { return dialog()->table()->rowCount() == 1; }, 3000));
  window_->history().stack().undo();
  EXPECT_TRUE(QTest::qWaitFor([&] { return dialog()->table()->rowCount() == 2; }, 3000));
}

}  // namespace
}  // namespace scantrove
