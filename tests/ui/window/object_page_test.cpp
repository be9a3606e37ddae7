// The page of an object in the window.
#include <gtest/gtest.h>

#include <QComboBox>
#include <QDir>
#include <QListWidget>
#include <QPushButton>
#include <QSignalSpy>
#include <opencv2/imgproc.hpp>

#include "core/session/catalogue_numbers.h"
#include "core/session/session_store.h"
#include "tests/ui/window/saved_key_frames.h"
#include "tests/ui/window/window_fixture.h"
#include "ui/main_window/main_actions.h"
#include "ui/main_window/object_pages.h"
#include "ui/main_window/scan_controller.h"
#include "ui/models/object_answers.h"
#include "ui/models/object_renamer.h"
#include "ui/panels/alike_list.h"
#include "ui/panels/object_attributes.h"
#include "ui/panels/object_delegate.h"
#include "ui/panels/object_head.h"
#include "ui/panels/object_page.h"
#include "ui/panels/same_name_choice.h"
#include "ui/view/model_view.h"

namespace scantrove::test {
namespace {

constexpr int kFilling_ms = 8000;
const Intrinsics kPageCamera{290, 290, 159.5F, 119.5F, 320, 240};

/// A thing with a pattern of its own, 0.9 m before the camera.
ObjectView patternView(int pattern, int frame) {
  ObjectView view = discView(cv::Scalar(0, 0, 0));
  cv::RNG random(static_cast<std::uint64_t>(pattern) * 977 + 5);
  cv::Mat cells(5, 5, CV_8UC3);
  random.fill(cells, cv::RNG::UNIFORM, 20, 236);
  cv::resize(cells, view.color, view.mask.size(), 0, 0, cv::INTER_CUBIC);
  view.frame_index = frame;
  view.size_m = {0.2F, 0.1F, 0.1F};
  view.box_px = {100, 80, view.mask.cols, view.mask.rows};
  view.frame_px = {320, 240};
  return view;
}

class ObjectPageTest : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    auto database = ObjectDatabase::open(file_.toStdString());
    ASSERT_TRUE(database);
    identity_ = (*database)->identity().value();
    const std::int64_t session = (*database)->sessions().begin("patterns", kPageCamera).value();
    // Two of one look among others.
    for (const int pattern : {1, 1, 2, 3, 4, 5}) {
      ObjectView view = patternView(pattern, static_cast<int>(patterned_.size()));
      view.session = session;
      patterned_.push_back((*database)->addObject(view).value().id);
    }
    window_->editor().poll();
  }
  void TearDown() override {
    QDir(scanFolder()).removeRecursively();
    WindowTest::TearDown();
  }

  [[nodiscard]] ObjectPages& pages() { return *window_->findChild<ObjectPages*>(); }
  [[nodiscard]] ObjectPage* page() { return pages().page(); }
  /// Opens the page with the key of the list, or turns to another object, and waits until it is filled.
  void openPage(ObjectId object) {
    QSignalSpy filled(&pages(), &ObjectPages::filled);
    if (page() != nullptr && page()->isVisible()) {
      pages().open(object);
    } else {
      list()->scrollTo(rowOf(object));
      clickOn(object);
      QTest::keyClick(list(), Qt::Key_Return, Qt::ControlModifier);
    }
    ASSERT_NE(page(), nullptr);
    ASSERT_TRUE(QTest::qWaitForWindowExposed(page()));
    ASSERT_TRUE(filled.count() > 0 || filled.wait(kFilling_ms));
  }
  void waitForFilled(const std::function<void()>& action) {
    QSignalSpy filled(&pages(), &ObjectPages::filled);
    action();
    ASSERT_TRUE(filled.wait(kFilling_ms));
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  }
  [[nodiscard]] QPushButton* alikeButton(const char* name) {
    return page()->alike()->findChild<QPushButton*>(QLatin1String(name));
  }
  [[nodiscard]] QString scanFolder() {
    return window_->controller().scansFolder() + QStringLiteral("/scan of a page");
  }
  /// A saved scan with a region that is the object.
  void saveScan(ObjectId object) {
    QDir().mkpath(window_->controller().scansFolder());
    const auto store = SessionStore::create(scanFolder().toStdString());
    ASSERT_TRUE(store) << store.error().message();
    SavedDelta delta;
    delta.metadata["source"] = "demo";
    delta.metadata["ended"] = "2026-11-22T15:40:02Z";
    delta.metadata["database"] = file_.toStdString();
    delta.metadata[kCatalogueKey] = identity_;
    addThreeKeyFrames(delta);
    delta.fragments = {{FragmentId{1}, RegionId{3}, 60}};
    delta.regions = {{RegionId{3}, object, {}}};
    ASSERT_TRUE((*store)->save(delta));
  }

  std::vector<ObjectId> patterned_;
  std::string identity_;
};

TEST_F(ObjectPageTest, OpensByDoubleClickOnThePicture_NotOnTheName) {
  const auto rectOf = [&] { return list()->visualRect(rowOf(objects_[1])); };
  list()->scrollTo(rowOf(objects_[1]));
  clickOn(objects_[1]);
  QTest::mouseDClick(list()->viewport(), Qt::LeftButton, {}, rectOf().center());
  EXPECT_EQ(page(), nullptr);
  ASSERT_NE(nameEditor(), nullptr);
  QTest::keyClick(nameEditor(), Qt::Key_Escape);
  QTest::mouseDClick(list()->viewport(), Qt::LeftButton, {}, ObjectDelegate::pictureRect(rectOf()).center());
  ASSERT_NE(page(), nullptr);
  EXPECT_TRUE(page()->isVisible());
  EXPECT_EQ(page()->object(), objects_[1]);
  EXPECT_EQ(nameEditor(), nullptr);
}

TEST_F(ObjectPageTest, ShowsNameStateViewsAndSides) {
  openPage(patterned_[2]);
  EXPECT_EQ(page()->head()->nameField()->text(), rowOf(patterned_[2]).data(Qt::DisplayRole).toString());
  EXPECT_EQ(page()->head()->state(), QStringLiteral("New, without a name"));
  ASSERT_EQ(page()->views()->count(), 1);
  EXPECT_FALSE(page()->views()->item(0)->icon().isNull());
  QTest::mouseClick(page()->head()->confirmButton(), Qt::LeftButton);
  EXPECT_TRUE(stored(patterned_[2]).confirmed);
  EXPECT_EQ(page()->head()->state(), QStringLiteral("Confirmed"));
  window_->parts().actions->undo->trigger();
  EXPECT_FALSE(stored(patterned_[2]).confirmed);
  QTest::keyClick(page(), Qt::Key_Escape);
  EXPECT_FALSE(page()->isVisible());
}

TEST_F(ObjectPageTest, NameFollowsTheRulesOfTheList) {
  openPage(patterned_[2]);
  QLineEdit* const field = page()->head()->nameField();
  field->setFocus();
  field->selectAll();
  QTest::keyClicks(field, QStringLiteral("cup/red cup"));
  QTest::keyClick(field, Qt::Key_Return);
  EXPECT_EQ(stored(patterned_[2]).name, "red cup");
  EXPECT_EQ(rowOf(patterned_[2]).data(ObjectListModel::ClassNameRole).toString(), QStringLiteral("cup"));
  EXPECT_EQ(page()->head()->state(), QStringLiteral("Named, not confirmed"));
  EXPECT_TRUE(page()->windowTitle().contains(QStringLiteral("red cup")));
  // Taken: another one, or the same.
  openPage(patterned_[3]);
  field->setFocus();
  field->selectAll();
  QTest::keyClicks(field, QStringLiteral("red cup"));
  EXPECT_TRUE(page()->head()->choice()->isAsking());
  QTest::keyClick(field, Qt::Key_Escape);
  EXPECT_FALSE(page()->head()->choice()->isAsking());
  EXPECT_TRUE(page()->isVisible()) << "Escape cancels the name first";
  EXPECT_EQ(field->text().toStdString(), stored(patterned_[3]).name);
  window_->parts().actions->undo->trigger();
  EXPECT_NE(stored(patterned_[2]).name, "red cup");
}

TEST_F(ObjectPageTest, SameObjectIsMerged_NamedOneStays_OneUndo) {
  ObjectRenamer renamer(window_->editor());
  ASSERT_TRUE(renamer.apply(patterned_[1], QStringLiteral("tin"), TypedName::Answer::another));
  openPage(patterned_[0]);
  ASSERT_NE(alikeButton("sameObject"), nullptr);
  const std::size_t before = storedCount();
  waitForFilled([&] { QTest::mouseClick(alikeButton("sameObject"), Qt::LeftButton); });
  EXPECT_EQ(storedCount(), before - 1);
  EXPECT_EQ(stored(patterned_[1]).name, "tin");
  EXPECT_EQ(stored(patterned_[1]).views, 2);
  EXPECT_EQ(page()->object(), patterned_[1]) << "the page follows";
  EXPECT_EQ(alikeButton("sameObject"), nullptr);
  window_->parts().actions->undo->trigger();
  EXPECT_EQ(storedCount(), before);
}

TEST_F(ObjectPageTest, DifferentObjectIsNotSuggestedAgain_AlsoAfterARestart) {
  openPage(patterned_[0]);
  ASSERT_NE(alikeButton("differentObject"), nullptr);
  waitForFilled([&] { QTest::mouseClick(alikeButton("differentObject"), Qt::LeftButton); });
  EXPECT_EQ(alikeButton("differentObject"), nullptr);
  waitForFilled([&] { window_->parts().actions->undo->trigger(); });
  ASSERT_NE(alikeButton("differentObject"), nullptr) << "undone";
  waitForFilled([&] { window_->parts().actions->redo->trigger(); });
  restart();
  openPage(patterned_[1]);
  EXPECT_EQ(alikeButton("differentObject"), nullptr);
}

TEST_F(ObjectPageTest, ListsTheScansThatHaveIt_AndOpensOne) {
  saveScan(patterned_[2]);
  openPage(patterned_[3]);
  EXPECT_EQ(page()->findChild<QPushButton*>(QStringLiteral("scanOfObject")), nullptr);
  openPage(patterned_[2]);
  auto* const link = page()->findChild<QPushButton*>(QStringLiteral("scanOfObject"));
  ASSERT_NE(link, nullptr);
  EXPECT_TRUE(link->text().contains(QStringLiteral("3 key frames"))) << link->text().toStdString();
  EXPECT_FALSE(page()->openButton()->isHidden());
  QTest::mouseClick(link, Qt::LeftButton);
  ASSERT_FALSE(worker_->commands.empty());
  EXPECT_EQ(worker_->commands.back(), "start");
  EXPECT_EQ(QFileInfo(window_->controller().sessionFolder()), QFileInfo(scanFolder()));
  EXPECT_TRUE(page()->isVisible());
}

TEST_F(ObjectPageTest, ModelIsOfTheViews_UntilAScanHasTheObject) {
  openPage(patterned_[2]);
  EXPECT_GT(pages().modelView()->pointCount(), 500U) << "about the pixels of the disc";
  EXPECT_TRUE(page()->modelNote().contains(QStringLiteral("1 view"))) << page()->modelNote().toStdString();

  window_->open(QStringLiteral("demo"));
  ScanSnapshot snapshot = snapshotOf(1);
  snapshot.changed_regions = {{FragmentId{1}, RegionId{5}}};
  snapshot.region_infos = std::make_shared<const RegionInfos>(
      RegionInfos{{.region = RegionId{5}, .voxels = 4000, .note = {}, .object = patterned_[2]}});
  CloudBrick brick{Eigen::Vector3i(0, 0, 32), 1, {}};
  for (int i = 0; i < 64; ++i) {
    const Eigen::Vector3f in_brick(Eigen::Vector3i(i % 8, i / 8, 0).cast<float>().array() + 0.5F);
    const Eigen::Vector3f point = (brick.position.cast<float>() * 8 + in_brick) * 3 / 512;
    brick.points.push_back({point.x(), point.y(), point.z(), FragmentId{1}, {}, 0, {}});
  }
  snapshot.changed_bricks.push_back(brick);
  worker_->report(std::move(snapshot));
  ASSERT_TRUE(QTest::qWaitFor([&] { return pages().modelView()->pointCount() == 64; }, kFilling_ms));
  EXPECT_EQ(page()->modelNote(), QStringLiteral("From the open scan."));
  window_->closeScan();
  openPage(patterned_[2]);
  EXPECT_NE(pages().modelView()->pointCount(), 64U);
}

TEST_F(ObjectPageTest, ModelTurnsSlowly_AndByHand) {
  openPage(patterned_[2]);
  ModelView* const view = pages().modelView();
  ASSERT_TRUE(view->isTurning());
  const Eigen::Vector3f first = view->viewDirection();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !view->viewDirection().isApprox(first, 1e-4F); }, kFilling_ms));
  QTest::keyClick(view, Qt::Key_Left);
  EXPECT_FALSE(view->isTurning()) << "a user turns it";
  const Eigen::Vector3f before = view->viewDirection();
  QTest::keyClick(view, Qt::Key_Right);
  EXPECT_FALSE(view->viewDirection().isApprox(before, 1e-4F));
  QTest::keyClick(view, Qt::Key_Left);
  EXPECT_TRUE(view->viewDirection().isApprox(before, 1e-4F));
  QTest::mousePress(view, Qt::LeftButton, {}, QPoint(50, 50));
  QTest::mouseMove(view, QPoint(90, 50));
  QTest::mouseRelease(view, Qt::LeftButton, {}, QPoint(90, 50));
  QTest::keyClick(view, Qt::Key_Space);
  EXPECT_TRUE(view->isTurning());
}

TEST_F(ObjectPageTest, AttributesOfTheClassAreAnswered) {
  ObjectRenamer renamer(window_->editor());
  ASSERT_TRUE(renamer.apply(patterned_[2], QStringLiteral("cup/cup"), TypedName::Answer::another));
  ClassDraft draft;
  {
    auto database = ObjectDatabase::open(file_.toStdString());
    ASSERT_TRUE(database);
    draft.id = (*database)->model().value().classes().named("cup")->id;
    draft.attributes = std::vector<ClassAttribute>{{"material", AttributeKind::choice, {"clay", "steel"}},
                                                   {"remark", AttributeKind::text, {}}};
    ASSERT_TRUE((*database)->classes().edit(draft));
  }
  window_->editor().poll();
  openPage(patterned_[2]);
  auto* const attributes = page()->findChild<ObjectAttributes*>();
  auto* const material = attributes->findChild<QComboBox*>();
  ASSERT_NE(material, nullptr);
  ASSERT_EQ(material->count(), 3);
  material->setFocus();
  QTest::keyClick(material, Qt::Key_Down);
  const ObjectAnswers answers(window_->editor());
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return answers.questions(patterned_[2])[0].answer == QStringLiteral("clay"); }, kFilling_ms));
  window_->parts().actions->undo->trigger();
  EXPECT_TRUE(answers.questions(patterned_[2])[0].answer.isEmpty());
  EXPECT_EQ(material->currentIndex(), 0);
}

TEST_F(ObjectPageTest, ClosesWhenTheObjectIsDeleted) {
  openPage(patterned_[2]);
  ASSERT_TRUE(window_->editor().remove({patterned_[2]}));
  EXPECT_FALSE(page()->isVisible());
}

}  // namespace
}  // namespace scantrove::test
