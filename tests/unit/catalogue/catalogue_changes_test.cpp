#include <gmock/gmock.h>

#include "catalogue_test_support.h"

namespace scantrove::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string describe(const CatalogueChange& change) {
  using Kind = CatalogueChange::Kind;
  const std::string id = std::to_string(change.object().value),
                    other = std::to_string(change.mergeTarget().value);
  switch (change.kind) {
    case Kind::added:
      return "added " + id;
    case Kind::view_added:
      return "view " + std::to_string(change.view) + " of " + id;
    case Kind::renamed:
      return id + " is now " + change.after.name;
    case Kind::confirmed:
      return "confirmed " + id;
    case Kind::unconfirmed:
      return "unconfirmed " + id;
    case Kind::removed:
      return "removed " + id;
    case Kind::restored:
      return "restored " + id;
    case Kind::merged:
      return id + " into " + other;
    case Kind::unmerged:
      return id + " out of " + other;
    case Kind::classified:
      return id + " has class " + std::to_string(change.after.classification.class_id.value);
    case Kind::class_added:
      return "class " + change.of_class->after.name;
    case Kind::class_edited:
      return "class " + change.of_class->before.name + " is now " + change.of_class->after.name;
    case Kind::class_hidden:
      return "hidden class " + change.of_class->after.name;
    case Kind::class_restored:
      return "restored class " + change.of_class->after.name;
    case Kind::class_merged:
      return "class " + change.of_class->after.name + " into " +
             std::to_string(change.of_class->after.merged_into.value);
    case Kind::class_unmerged:
      return "class " + change.of_class->after.name + " out of " +
             std::to_string(change.of_class->before.merged_into.value);
    case Kind::views_discarded:
      break;
  }
  return "views discarded of " + id;
}

class CatalogueChangesTest : public CatalogueTest {
 protected:
  /// Changes that `database` reports since the last call, as text.
  std::vector<std::string> newChanges(ObjectDatabase& database) {
    const Result<CatalogueChanges> changes = database.changesAfter(last_event_);
    if (!changes) return {changes.error().message()};
    last_event_ = changes->last_event;
    std::vector<std::string> texts;
    for (const CatalogueChange& change : changes->changes) texts.push_back(describe(change));
    return texts;
  }
  std::int64_t last_event_ = 0;
};

TEST_F(CatalogueChangesTest, ReportsChangesOfOtherConnections) {
  const auto window = openOrFail(file()), worker = openOrFail(file());
  EXPECT_EQ(*window->lastEvent(), 0);
  EXPECT_THAT(newChanges(*window), IsEmpty());

  ObjectView view = randomView(0);
  view.session = *worker->sessions().begin("demo");
  const ObjectId a = worker->addObject(view)->id, b = worker->addObject(randomView(1))->id;
  EXPECT_THAT(newChanges(*window), ElementsAre("added 1", "view 1 of 1", "added 2", "view 2 of 2"));
  EXPECT_EQ(last_event_, *window->lastEvent());
  EXPECT_THAT(newChanges(*window), IsEmpty());

  EXPECT_TRUE(window->rename(a, "mug \xC3\xA4 \"x\""));
  EXPECT_TRUE(window->setConfirmed({&b, 1}, true));
  EXPECT_TRUE(window->setConfirmed({&b, 1}, true));  // no change, no event
  EXPECT_FALSE(window->rename(b, "mug \xC3\xA4 \"x\""));
  EXPECT_THAT(newChanges(*worker), ElementsAre("1 is now mug \xC3\xA4 \"x\"", "confirmed 2"));

  const ObjectMerge merge = *window->merge(std::array{a, b});
  EXPECT_THAT(newChanges(*worker), ElementsAre("2 into 1", "confirmed 1"));
  view.object = b;
  EXPECT_TRUE(worker->addView(view));
  EXPECT_THAT(newChanges(*window), ElementsAre("view 3 of 1"));
  EXPECT_TRUE(window->unmerge(merge));
  EXPECT_THAT(newChanges(*worker), ElementsAre("2 out of 1", "unconfirmed 1"));

  EXPECT_TRUE(window->remove(std::array{a, b}));
  EXPECT_TRUE(window->restore({&b, 1}));
  EXPECT_TRUE(worker->sessions().end(view.session));
  EXPECT_THAT(newChanges(*worker), ElementsAre("removed 1", "removed 2", "restored 2"));
}

TEST_F(CatalogueChangesTest, ReportsChangesOfClasses) {
  const auto window = openOrFail(file()), worker = openOrFail(file());
  const ObjectId chair = worker->addObject(randomView(0))->id;
  static_cast<void>(newChanges(*window));
  const ClassId seat = *worker->classes().add({.name = "seat", .supercategory = "furniture"});
  const ClassId stool = *worker->classes().add({.name = "stool"});
  ASSERT_TRUE(worker->classes().edit({.id = seat, .name = "chair"}));
  ASSERT_TRUE(worker->classes().classify({&chair, 1}, stool));
  const ClassMerge merge = *worker->classes().merge({&stool, 1}, seat);
  ASSERT_TRUE(worker->classes().unmerge(merge));
  ASSERT_TRUE(worker->classes().hide({&seat, 1}));
  ASSERT_TRUE(worker->classes().restore({&seat, 1}));
  EXPECT_THAT(newChanges(*window), ElementsAre("class seat", "class stool", "class seat is now chair",
                                               "1 has class 2", "class stool into 1", "class stool out of 1",
                                               "hidden class chair", "restored class chair"));
  const CatalogueChanges all = *window->changesAfter(0);
  EXPECT_EQ(all.changes.back().of_class->after, *window->model()->classes().find(seat)) << "all of it";
  EXPECT_FALSE(all.changes.back().object());
}

TEST_F(CatalogueChangesTest, SkipsMalformedEvents) {
  const auto database = openOrFail(file());
  ASSERT_TRUE(database->addObject(randomView(0)));
  askDatabase(file(), "INSERT INTO events (created, action, object) VALUES ('', 'juggle', 1)");
  askDatabase(file(), "INSERT INTO events (created, action, after_json) VALUES ('', 'rename', '{}')");
  askDatabase(file(),
              "INSERT INTO events (created, action, object, after_json) VALUES ('', 'rename', 1, '[')");
  askDatabase(file(), "INSERT INTO events (created, action, object) VALUES ('', 'merge', 1)");
  for (const char* json :
       {"{}", "[", R"({"class": 0, "color": "#000000"})", R"({"class": 3, "color": "red"})"}) {
    askDatabase(
        file(),
        QString("INSERT INTO events (created, action, after_json) VALUES ('', 'class-add', '%1')").arg(json));
  }
  EXPECT_THAT(newChanges(*database), ElementsAre("added 1", "view 1 of 1"));
  EXPECT_EQ(last_event_, *database->lastEvent());
}

TEST_F(CatalogueChangesTest, EventsStoreStatesBeforeAndAfter) {
  const auto database = openOrFail(file());
  const ObjectId a = database->addObject(randomView(0))->id, b = database->addObject(randomView(1))->id;
  EXPECT_TRUE(database->rename(a, "mug"));
  EXPECT_TRUE(database->merge(std::array{a, b}));
  EXPECT_EQ(askDatabase(file(), "SELECT before_json FROM events WHERE action = 'rename'"),
            R"({"confirmed":false,"hidden":false,"name":"Obj_1","named_by_person":false})");
  EXPECT_EQ(askDatabase(file(), "SELECT after_json FROM events WHERE action = 'merge'"),
            R"({"confirmed":false,"hidden":true,"merged_into":1,"name":"Obj_2","named_by_person":false})");
}

}  // namespace
}  // namespace scantrove::test
