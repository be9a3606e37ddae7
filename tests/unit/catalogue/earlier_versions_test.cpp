// Catalogues of every earlier schema version, opened with today's program. They are of both kinds of
// databases: the tests of servers run this file, too.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>

#include "catalogue_test_support.h"
#include "core/catalogue/catalogue_schema.h"
#include "earlier_catalogue.h"

namespace scantrove::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A catalogue for each version, in a database of its own.
class EarlierVersionsTest : public CatalogueTest {
 protected:
  [[nodiscard]] static int newest() { return static_cast<int>(schema::catalogueSteps().size()); }
  [[nodiscard]] std::string written(int version) const {
    const std::string database = file("version" + std::to_string(version) + ".sqlite");
    EarlierCatalogue::write(database, version);
    return database;
  }
  static std::vector<StoredDescriptor> descriptorsOf(ObjectDatabase& database) {
    std::vector<StoredDescriptor> found;
    EXPECT_TRUE(
        database.views().forEachDescriptor(0, [&](const StoredDescriptor& one) { found.push_back(one); }));
    return found;
  }
};

TEST_F(EarlierVersionsTest, KeepEveryValue_WhenTheyAreOpened) {
  for (int version = 1; version <= newest(); ++version) {
    SCOPED_TRACE("version " + std::to_string(version));
    const std::string database = written(version);
    const auto before = storedRows(database);
    ASSERT_EQ(before.at("views").size(), static_cast<std::size_t>(EarlierCatalogue::kObjects));
    {
      const auto opened = openOrFail(database);
      ASSERT_NE(opened, nullptr);
      expectKept(before, storedRows(database));
      descriptorsOf(*opened);  // what is missing is computed now
    }
    const auto after = storedRows(database);
    expectKept(before, after);
    EXPECT_EQ(after.at("descriptors").size(), before.at("views").size());
    EXPECT_EQ(askDatabase(database, "SELECT max(version) FROM schema_migrations"), std::to_string(newest()));
    EXPECT_EQ(askDatabase(database, "SELECT count(*) FROM schema_migrations"), std::to_string(newest()));
  }
}

TEST_F(EarlierVersionsTest, HaveTheirObjectsAndNames_WhenTheyAreOpened) {
  for (int version = 1; version <= newest(); ++version) {
    SCOPED_TRACE("version " + std::to_string(version));
    const auto database = openOrFail(written(version));
    ASSERT_NE(database, nullptr);
    std::vector<std::string> names;
    const Result<std::vector<ObjectRecord>> objects = database->objects();
    ASSERT_TRUE(objects);
    for (const ObjectRecord& object : *objects) {
      names.push_back(object.name);
      const bool is_named = object.id.value == 2 || object.id.value == 6;
      EXPECT_EQ(object.named_by, is_named ? NamedBy::user : NamedBy::program) << object.name;
      EXPECT_EQ(object.confirmed, object.id.value == 2) << object.name;
      EXPECT_EQ(object.views, object.id.value == 1 ? 2 : 1) << object.name;
      EXPECT_EQ(object.size_m, Eigen::Vector3f(0.3F, 0.2F, 0.1F)) << object.name;
      EXPECT_EQ(object.first_session_name, "kitchen");
    }
    EXPECT_THAT(names, ElementsAre("Obj_1", "blue mug", "Obj_5 (2)", EarlierCatalogue::kNameOfSix));
    EXPECT_EQ(*database->mergeRoot(ObjectId{3}), ObjectId{1});
    EXPECT_FALSE(*database->mergeRoot(ObjectId{4})) << "it was deleted";
    EXPECT_THAT(database->model()->classes().all(), IsEmpty());

    EXPECT_TRUE(database->restore(std::array{ObjectId{4}}));
    EXPECT_EQ(database->object(ObjectId{4})->name, "Obj_4");
    EXPECT_TRUE(database->unmerge({ObjectId{1}, {ObjectId{3}}}));
    EXPECT_EQ(database->object(ObjectId{3})->views, 1) << "its own view comes back";
    const Result<ObjectRecord> next = database->addObject(randomView(0));
    ASSERT_TRUE(next) << next.error().message();
    EXPECT_EQ(next->id.value, 8U);
    EXPECT_EQ(next->name, version >= 8 ? "Obj_7" : "Obj_8") << "no number is given twice";
  }
}

TEST_F(EarlierVersionsTest, HaveTheirViews_WhenTheyAreOpened) {
  for (int version = 1; version <= newest(); ++version) {
    SCOPED_TRACE("version " + std::to_string(version));
    const auto database = openOrFail(written(version));
    ASSERT_NE(database, nullptr);
    const Result<std::vector<ObjectView>> views = database->views().of(ObjectId{1});
    ASSERT_TRUE(views);
    ASSERT_EQ(views->size(), 2U);
    for (const ObjectView& view : *views) {
      const ObjectView expected = randomView(EarlierCatalogue::seedOf(view.id));
      EXPECT_TRUE(sameImage(view.color, expected.color));
      EXPECT_TRUE(sameImage(view.mask, expected.mask));
      EXPECT_TRUE(sameImage(view.depth_mm, expected.depth_mm));
      EXPECT_EQ(view.frame_index, 10 * view.id);
      EXPECT_EQ(view.T_world_camera.translation(), Eigen::Vector3d(0.25, -0.5, 0.1));
      EXPECT_EQ(view.box_px, version >= 3 ? cv::Rect(5, 20, 40, 30) : cv::Rect());
    }
    const std::vector<StoredDescriptor> descriptors = descriptorsOf(*database);
    ASSERT_EQ(descriptors.size(), static_cast<std::size_t>(EarlierCatalogue::kObjects));
    for (const StoredDescriptor& one : descriptors) {
      EXPECT_EQ(one.first_object.value, static_cast<std::uint32_t>(one.view));
      EXPECT_EQ(one.place.has_value(), version >= 5);
      ASSERT_TRUE(one.descriptor.colors);
      if (version >= 2) {
        const QByteArray stored = EarlierCatalogue::thumbnailOf(one.view);
        EXPECT_TRUE(std::equal(stored.begin(), stored.end(), one.descriptor.thumbnail.fine.begin()));
      }
      if (version >= 8) {
        const QByteArray stored = EarlierCatalogue::colorsOf(one.view);
        EXPECT_TRUE(std::ranges::equal(stored, one.descriptor.colors->roots, {},
                                       [](char root) { return static_cast<std::uint8_t>(root); }));
      }
    }
  }
}

TEST_F(EarlierVersionsTest, KeepHistoryIdentityAndCameras_WhenTheyAreOpened) {
  for (int version = 1; version <= newest(); ++version) {
    SCOPED_TRACE("version " + std::to_string(version));
    const std::string file = written(version);
    const std::string identity =
        version >= 6 ? askDatabase(file, "SELECT uuid FROM identity") : std::string();
    const auto database = openOrFail(file);
    ASSERT_NE(database, nullptr);
    EXPECT_EQ(database->identity()->size(), 36U);
    if (version >= 6) {
      EXPECT_EQ(*database->identity(), identity);
    }
    EXPECT_EQ(database->sessions().cameras()->size(), version >= 4 ? 1U : 0U);
    if (version >= 7) {
      const Result<std::string> again = database->applyOnce(EarlierCatalogue::kToken, [] {
        ADD_FAILURE() << "it was applied before";
        return Result<std::string>("");
      });
      EXPECT_EQ(again.value_or(""), "the \"result\"");
    }
    std::vector<CatalogueChange::Kind> kinds;
    const Result<CatalogueChanges> history = database->changesAfter(0);
    ASSERT_TRUE(history);
    for (const CatalogueChange& change : history->changes) {
      if (change.kind != CatalogueChange::Kind::added) kinds.push_back(change.kind);
      if (change.kind == CatalogueChange::Kind::renamed) {
        EXPECT_EQ(change.after.name, "blue mug");
      }
    }
    using Kind = CatalogueChange::Kind;
    EXPECT_THAT(kinds, ElementsAre(Kind::renamed, Kind::merged, Kind::removed));
  }
}

}  // namespace
}  // namespace scantrove::test
