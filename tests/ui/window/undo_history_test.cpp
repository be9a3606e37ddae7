#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QUndoCommand>
#include <string>

#include "ui/models/undo_history.h"

namespace scantrove {
namespace {

using testing::ElementsAre;

/// Records each redo ("+name") and undo ("-name").
class UndoHistoryTest : public testing::Test {
 protected:
  class RecordedStep : public QUndoCommand {
   public:
    RecordedStep(const char* name, std::vector<std::string>& notes)
        : QUndoCommand(QString::fromLatin1(name)), name_(name), notes_(notes) {}
    void redo() override { notes_.push_back("+" + name_); }
    void undo() override { notes_.push_back("-" + name_); }

   private:
    std::string name_;
    std::vector<std::string>& notes_;
  };

  UndoHistory::Step step(const char* name) { return std::make_shared<RecordedStep>(name, notes_); }
  void undoAll() {
    while (history_.stack().canUndo()) history_.stack().undo();
  }

  std::vector<std::string> notes_;
  UndoHistory history_;
  const int catalogue_ = 0, regions_ = 0;
};

TEST_F(UndoHistoryTest, UndoesStepsOfAllOwnersInReverseOrder) {
  history_.push(&regions_, step("name"));
  history_.push(&catalogue_, step("rename"));
  history_.push(&regions_, step("join"));
  EXPECT_EQ(history_.stack().undoText(), QStringLiteral("join"));
  undoAll();
  EXPECT_THAT(notes_, ElementsAre("+name", "+rename", "+join", "-join", "-rename", "-name"));
  history_.stack().redo();
  EXPECT_EQ(notes_.back(), "+name");
}

TEST_F(UndoHistoryTest, ForgetsTheStepsOfAnOwner_WithoutUndoingThem) {
  history_.push(&regions_, step("name"));
  history_.push(&catalogue_, step("rename"));
  history_.push(&catalogue_, step("delete"));
  history_.stack().undo();
  notes_.clear();
  history_.forget(&regions_);
  EXPECT_TRUE(notes_.empty());
  EXPECT_EQ(history_.stack().undoText(), QStringLiteral("rename"));
  EXPECT_EQ(history_.stack().redoText(), QStringLiteral("delete"));
  undoAll();
  EXPECT_THAT(notes_, ElementsAre("-rename"));
}

TEST_F(UndoHistoryTest, StepsOfAnOpenedScanPrecedeNewSteps) {
  history_.push(&catalogue_, step("rename"));
  notes_.clear();
  history_.prepend(&regions_, {step("name"), step("cut"), step("undone")}, 2);
  EXPECT_TRUE(notes_.empty()) << "they are done already";
  EXPECT_FALSE(history_.stack().canRedo()) << "a newer step exists";
  undoAll();
  EXPECT_THAT(notes_, ElementsAre("-rename", "-cut", "-name"));
}

TEST_F(UndoHistoryTest, UndoneStepsOfAnOpenedScanCanBeRedone) {
  history_.prepend(&regions_, {step("name"), step("cut")}, 1);
  EXPECT_EQ(history_.stack().redoText(), QStringLiteral("cut"));
  history_.stack().redo();
  EXPECT_THAT(notes_, ElementsAre("+cut"));
}

TEST_F(UndoHistoryTest, AppendedStepIsDoneAlready_AndEndsRedoing) {
  history_.push(&regions_, step("name"));
  history_.push(&regions_, step("cut"));
  history_.stack().undo();
  notes_.clear();
  history_.append(&regions_, step("mark"));
  EXPECT_TRUE(notes_.empty());
  EXPECT_FALSE(history_.stack().canRedo());
  undoAll();
  EXPECT_THAT(notes_, ElementsAre("-mark", "-name"));
}

TEST_F(UndoHistoryTest, UndoesTheNewestStep_OnlyForItsOwner) {
  history_.push(&regions_, step("cut"));
  history_.push(&catalogue_, step("rename"));
  EXPECT_FALSE(history_.undoNewest(&regions_));
  EXPECT_TRUE(history_.undoNewest(&catalogue_));
  EXPECT_TRUE(history_.undoNewest(&regions_));
  EXPECT_FALSE(history_.undoNewest(&regions_));
  EXPECT_THAT(notes_, ElementsAre("+cut", "+rename", "-rename", "-cut"));
}

TEST_F(UndoHistoryTest, ForgetsAFailedStep) {
  const UndoHistory::Step failed = step("join");
  history_.push(&regions_, step("name"));
  history_.push(&regions_, failed);
  history_.push(&catalogue_, step("rename"));
  history_.forget(*failed);
  notes_.clear();
  undoAll();
  EXPECT_THAT(notes_, ElementsAre("-rename", "-name"));
}

}  // namespace
}  // namespace scantrove
