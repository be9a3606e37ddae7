// Classes in a catalogue on disk.
#include <gmock/gmock.h>

#include <array>

#include "catalogue_test_support.h"
#include "core/catalogue/stored_namings.h"

namespace scantrove::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

using StoredClassesTest = CatalogueTest;

TEST_F(StoredClassesTest, ReadBackEqual_WhenTheCatalogueIsReopened) {
  CatalogueModel before;
  {
    const auto database = openOrFail(file());
    const ObjectId a = database->addObject(randomView(0))->id, b = database->addObject(randomView(1))->id;
    const ClassId chair = *database->classes().add(
        {.name = "Stuhl \xC3\xA4",
         .color = ClassColor{1, 2, 3},
         .supercategory = "M\xC3\xB6"
                          "bel",
         .attributes = {{{"material", AttributeKind::choice, {"wood", "it's \"steel\""}}}}});
    const ClassId stool = *database->classes().add({.name = "stool"});
    ASSERT_TRUE(database->classes().classify(std::array{a}, chair));
    ASSERT_TRUE(database->classes().classify(std::array{b}, stool));
    ASSERT_TRUE(database->classes().answer(std::array{a}, "material", "it's \"steel\""));
    ASSERT_TRUE(database->classes().merge(std::array{stool}, chair));
    before = *database->model();
    EXPECT_EQ(before.find(a)->classification.attributes.at("material"), "it's \"steel\"");
  }
  for (const bool is_to_read : {false, true}) {
    const auto database = is_to_read ? ObjectDatabase::openToRead(file()) : ObjectDatabase::open(file());
    ASSERT_TRUE(database);
    const Result<CatalogueModel> model = (*database)->model();
    ASSERT_TRUE(model);
    EXPECT_EQ(model->classes().all(), before.classes().all());
    EXPECT_EQ(model->objects(), before.objects());
    EXPECT_EQ((*database)->object(ObjectId{2})->classification.class_id, ClassId{2});
    EXPECT_EQ(model->classOf((*database)->object(ObjectId{2})->classification)->id, ClassId{1});
  }
}

TEST_F(StoredClassesTest, CatalogueOfVersionEightKeepsAll_WithoutClasses) {
  std::vector<ObjectRecord> before;
  {
    const auto database = openOrFail(file());
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(database->addObject(randomView(i)));
    ASSERT_TRUE(database->rename(ObjectId{2}, "mug"));
    ASSERT_TRUE(database->setConfirmed(std::array{ObjectId{2}}, true));
    ASSERT_TRUE(database->merge(std::array{ObjectId{1}, ObjectId{3}}));
    before = *database->objects();
  }
  forgetClasses(file());
  {
    const auto reader = ObjectDatabase::openToRead(file());
    ASSERT_TRUE(reader) << reader.error().message();
    EXPECT_EQ((*reader)->objects()->size(), before.size());
    EXPECT_EQ((*reader)->object(ObjectId{2})->name, "mug");
    const Result<CatalogueModel> model = (*reader)->model();
    ASSERT_TRUE(model);
    EXPECT_THAT(model->classes().all(), IsEmpty());
    EXPECT_EQ(model->mergeRoot(ObjectId{3}), ObjectId{1});
    EXPECT_TRUE((*reader)->changesAfter(0));
    EXPECT_EQ(askSqlite(file(), "PRAGMA user_version"), "8") << "reading changes nothing";
  }
  const auto database = openOrFail(file());
  ASSERT_NE(database, nullptr);
  EXPECT_EQ(askSqlite(file(), "PRAGMA user_version"), "9");
  const std::vector<ObjectRecord> after = *database->objects();
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_EQ(after[i].id, before[i].id);
    EXPECT_EQ(after[i].name, before[i].name);
    EXPECT_EQ(after[i].confirmed, before[i].confirmed);
    EXPECT_EQ(after[i].views, before[i].views);
    EXPECT_EQ(after[i].classification, Classification{});
  }
  EXPECT_EQ(*database->classes().add({.name = "mug"}), ClassId{1});
}

TEST_F(StoredClassesTest, NamingIsUndone_AfterItWasStoredAsText) {
  const auto database = openOrFail(file());
  const ObjectId a = database->addObject(randomView(0))->id, b = database->addObject(randomView(1))->id;
  ASSERT_TRUE(database->nameByUser(b, "chair"));
  const ObjectNaming naming = *database->nameByUser(a, "chair", "seat");
  EXPECT_EQ(naming.object, b);
  EXPECT_EQ(database->model()->classOf(database->object(b)->classification)->name, "seat");
  const std::vector<StoredNaming> read = namingsFromJson(namingsToJson({{naming, a, {}}}));
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].naming.reclassified, naming.reclassified);
  EXPECT_EQ(read[0].naming.made_class, naming.made_class);
  ASSERT_TRUE(*database->revertNaming(read[0].naming));
  EXPECT_EQ(database->object(b)->classification, Classification{});
  EXPECT_THAT(database->model()->classes().visible(), IsEmpty()) << "the class was made for the naming";
  EXPECT_EQ(*database->mergeRoot(a), a);
}

TEST_F(StoredClassesTest, MadeClassStays_WhenAnotherObjectHasItByNow) {
  const auto database = openOrFail(file());
  const ObjectId a = database->addObject(randomView(0))->id, b = database->addObject(randomView(1))->id;
  const ObjectNaming naming = *database->nameByUser(a, "chair", "chair");
  ASSERT_TRUE(database->classes().classify(std::array{b}, naming.made_class));
  ASSERT_TRUE(*database->revertNaming(naming));
  EXPECT_EQ(database->model()->classes().visible().size(), 1U);
  EXPECT_THAT(database->classes().hide(std::array{naming.made_class}).error().message(),
              testing::AllOf(HasSubstr(file()), HasSubstr("chair")));
}

TEST_F(StoredClassesTest, DamagedRowsAreReadWithoutThem) {
  const auto database = openOrFail(file());
  const ObjectId a = database->addObject(randomView(0))->id;
  ASSERT_TRUE(database->classes().add({.name = "chair"}));
  for (const char* sql :
       {"INSERT INTO classes (id, name, color, created) VALUES (-5, 'a', '#000000', '')",
        "INSERT INTO classes (id, name, color, created) VALUES (4294967297, 'b', '#000000', '')",
        "INSERT INTO classes (id, name, color, attributes, created) VALUES (7, 'c', 'red', '[{]', '')",
        "UPDATE objects SET class = 7, attributes = '[1]'"})
    askSqlite(file(), sql);
  const Result<CatalogueModel> model = database->model();
  ASSERT_TRUE(model);
  EXPECT_EQ(model->classes().all().size(), 2U);
  EXPECT_EQ(model->classes().find(ClassId{7})->color, defaultClassColor(ClassId{7}));
  EXPECT_THAT(model->classes().find(ClassId{7})->attributes, IsEmpty());
  EXPECT_THAT(model->find(a)->classification.attributes, IsEmpty());
}

TEST_F(StoredClassesTest, ImportChangesNothing_WhenOneClassIsNotValid) {
  const auto database = openOrFail(file());
  const std::vector<ClassDraft> list{{.name = "chair"}, {.name = "12"}};
  EXPECT_FALSE(database->classes().import(list));
  EXPECT_THAT(database->model()->classes().all(), IsEmpty());
  EXPECT_EQ(database->classes().import(std::array{list[0]})->added, 1);
}

}  // namespace
}  // namespace scantrove::test
