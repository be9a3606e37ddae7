#include "core/catalogue/class_list.h"

#include <gmock/gmock.h>

#include <array>
#include <string>

#include "core/catalogue/catalogue_model.h"
#include "core/catalogue/class_import.h"
#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::vector<ObjectClass> someClasses() {
  ObjectClass chair{ClassId{3}, "chair", {255, 128, 0}, "furniture", {}};
  chair.attributes = {{"material", AttributeKind::choice, {"wood", "\"steel\""}},
                      {"broken", AttributeKind::yes_no},
                      {"note"}};
  const ObjectClass odd{ClassId{kLargestClassId}, "Stuhl, \"gro\xC3\x9F\" =1+1", {0, 0, 1}, "a,b", {}};
  return {chair, odd};
}

std::vector<ClassDraft> draftsOf(const std::vector<ObjectClass>& classes) {
  std::vector<ClassDraft> drafts;
  for (const ObjectClass& one : classes) drafts.push_back(draftOf(one));
  return drafts;
}

std::string whyNot(const std::string& text) {
  const auto list = parseClassList(text, "list.txt");
  EXPECT_FALSE(list) << text;
  if (list) return "";
  EXPECT_THAT(list.error().what, HasSubstr("list.txt"));
  return list.error().message();
}

TEST(ClassList, JsonReadsBackEqual) {
  EXPECT_EQ(parseClassList(classListToJson(someClasses()), "x").value(), draftsOf(someClasses()));
  EXPECT_THAT(parseClassList(classListToJson({}), "x").value(), IsEmpty());
}

TEST(ClassList, CsvReadsBackEqual_WithoutAttributes) {
  std::vector<ClassDraft> drafts = draftsOf(someClasses());
  for (ClassDraft& draft : drafts) draft.attributes.reset();
  EXPECT_EQ(parseClassList(classListToCsv(someClasses()), "x").value(), drafts);
  EXPECT_EQ(classListToCsv(someClasses()).substr(0, 59),
            "id,name,supercategory,color\n3,chair,furniture,#ff8000\n21474");
}

TEST(ClassList, ReadsTheCategoriesOfACocoFile) {
  const auto list = parseClassList(
      R"({"images": [{"id": 1}], "annotations": [{"segmentation": [[1, 2, 3]], "categories": 5}],
          "categories": [{"id": 1, "name": "person", "supercategory": "person", "isthing": 1},
                         {"id": 90, "name": "toothbrush"}]})",
      "x");
  ASSERT_TRUE(list) << list.error().message();
  EXPECT_THAT(*list, ElementsAre(ClassDraft{.id = ClassId{1}, .name = "person", .supercategory = "person"},
                                 ClassDraft{.id = ClassId{90}, .name = "toothbrush"}));
}

TEST(ClassList, ReadsCsvOfOtherPrograms) {
  const auto list = parseClassList("\xEF\xBB\xBFname , id\r\n\"a \"\"b\"\", c\",7\r\nmug,\r\n\r\n", "x");
  ASSERT_TRUE(list) << list.error().message();
  EXPECT_THAT(*list,
              ElementsAre(ClassDraft{.id = ClassId{7}, .name = "a \"b\", c"}, ClassDraft{.name = "mug"}));
  EXPECT_THAT(parseClassList("name\nchair\ntable", "x").value(), SizeIs(2));
}

TEST(ClassList, IsRefused_WhenIdsOrNamesAreNotValidOrOccurTwice) {
  for (const char* id : {"0", "-1", "2147483648", "4294967297", "1.5", "1e3", "x", "99999999999999999999"}) {
    EXPECT_THAT(whyNot("id,name\n" + std::string(id) + ",mug\n"), HasSubstr("no id from 1 to 2147483647"));
    const std::string json = R"({"categories": [{"name": "mug", "id": )" + std::string(id) + "}]}";
    EXPECT_NE(whyNot(json), "");
  }
  EXPECT_THAT(whyNot("id,name\n1,mug\n1,cup\n"), HasSubstr("the id 1 occurs twice"));
  EXPECT_THAT(whyNot("id,name\n1,mug\n2, mug\n"), HasSubstr("the name 'mug' occurs twice"));
  EXPECT_THAT(whyNot("name\n12\n"), HasSubstr("number alone"));
  EXPECT_THAT(whyNot("id,name\n1,\n"), HasSubstr("class 1 has no name"));
  EXPECT_THAT(whyNot("name\n" + std::string(300, 'x')), HasSubstr("300 characters"));
  EXPECT_THAT(whyNot("name\n\xFF\n"), HasSubstr("UTF-8"));
  EXPECT_THAT(whyNot("name,color\nmug,red\n"), HasSubstr("'red' is no color"));
  EXPECT_THAT(whyNot(R"({"categories": [{"id": 1, "name": "a\nb"}]})"), HasSubstr("control characters"));
}

TEST(ClassList, IsRefused_WhenItsFormIsAnother) {
  for (const char* text :
       {"", " \n", "{", "{}", "[]", R"({"categories": {}})", R"({"categories": [7]})",
        R"({"categories": [{"id": 1}]})", R"({"categories": [{"name": 1}]})",
        R"({"categories": [{"name": "a", "scantrove": []}]})",
        R"({"categories": [{"name": "a", "scantrove": {"color": 7}}]})",
        R"({"categories": [{"name": "a", "scantrove": {"attributes": [{"name": "b", "kind": "x"}]}}]})",
        "id\n1\n", "name,name\na,b\n", "name,weight\na,b\n", "id,name\n1\n", "name\n\"a\n", "name\n\"a\"b\n"})
    whyNot(text);
  EXPECT_THAT(whyNot("{"), HasSubstr("no valid JSON at byte 2"));
  EXPECT_THAT(whyNot("{}"), HasSubstr("no list of categories"));
  EXPECT_THAT(whyNot(R"({"categories": [{"name": "a"}, {"name": 1}]})"), HasSubstr("class 2 lacks its name"));
  EXPECT_THAT(whyNot("{\"categories\": " + std::string(100'000, '[')), HasSubstr("nested too deep"));
  EXPECT_THAT(whyNot("name" + std::string(1'000'000, ',')), HasSubstr("no line of CSV"));
}

TEST(ClassList, IsRefused_WhenItIsTooLarge) {
  std::string many = "name\n";
  for (std::size_t i = 0; i <= kMostListedClasses; ++i) many += "class " + std::to_string(i) + '\n';
  EXPECT_THAT(whyNot(many), HasSubstr("more than 10000 classes"));
  EXPECT_THAT(whyNot(std::string(kLargestClassList + 1, 'x')), HasSubstr("more than 16 MiB"));
}

TEST(ClassList, NamesTheFile_WhenItCannotBeRead) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(readClassList(folder / "none.json").error().message(), HasSubstr("none.json"));
  const auto file = folder.write("list.csv", "id,name\n4,chair\n");
  EXPECT_THAT(readClassList(file).value(), SizeIs(1));
}

// Imports.

class ClassImportTest : public testing::Test {
 protected:
  ClassImport import(const std::vector<ClassDraft>& list) {
    const Result<ClassImport> import = importClasses(model_, list);
    EXPECT_TRUE(import) << import.error().message();
    return import.value_or(ClassImport{});
  }
  [[nodiscard]] std::string nameOf(std::uint32_t id) const {
    const ObjectClass* known = model_.classes().find(ClassId{id});
    return known == nullptr ? "" : known->name;
  }

  CatalogueModel model_{"the file"};
};

TEST_F(ClassImportTest, AddsAll_AndChangesNothing_WhenItIsRepeated) {
  const ClassImport first = import(draftsOf(someClasses()));
  EXPECT_EQ(first.added, 2);
  EXPECT_EQ(model_.classes().visible(), someClasses());
  static_cast<void>(model_.takeChanges());
  const ClassImport again = import(draftsOf(someClasses()));
  EXPECT_EQ(again.unchanged, 2);
  EXPECT_THAT(again.conflicts, IsEmpty());
  EXPECT_THAT(model_.takeChanges(), IsEmpty());
}

TEST_F(ClassImportTest, GivesFreeIdsToClassesWithoutOne) {
  EXPECT_EQ(import({{.name = "mug"}, {.id = ClassId{1}, .name = "chair"}}).added, 2);
  EXPECT_EQ(nameOf(1), "chair");
  EXPECT_EQ(nameOf(2), "mug");
}

TEST_F(ClassImportTest, UpdatesByName_AndKeepsTheId) {
  ASSERT_TRUE(model_.addClass({.name = "chair"}));
  const ClassImport done = import({{.id = ClassId{62}, .name = "chair", .supercategory = "furniture"}});
  EXPECT_EQ(done.updated, 1);
  EXPECT_THAT(done.conflicts, ElementsAre(AllOf(HasSubstr("chair (62 in the list)"), HasSubstr("its id 1"))));
  EXPECT_EQ(model_.classes().find(ClassId{1})->supercategory, "furniture");
  EXPECT_EQ(model_.classes().find(ClassId{62}), nullptr);
}

TEST_F(ClassImportTest, UpdatesById_UnlessObjectsHaveTheClass) {
  ASSERT_TRUE(model_.addClass({.name = "seat"}));
  ASSERT_TRUE(model_.addClass({.name = "mug"}));
  model_.put({ObjectId{1}, "red mug", NamedBy::user, true, false, {}, {ClassId{2}, {}}});
  const ClassImport done =
      import({{.id = ClassId{1}, .name = "chair"}, {.id = ClassId{2}, .name = "bicycle"}});
  EXPECT_EQ(nameOf(1), "chair");
  EXPECT_EQ(nameOf(2), "mug") << "the mug does not become a bicycle";
  EXPECT_THAT(done.conflicts, ElementsAre(AllOf(HasSubstr("bicycle"), HasSubstr("called mug"))));
}

TEST_F(ClassImportTest, RestoresHiddenClasses_ButNoMergedOnes) {
  const ClassId seat = model_.addClass({.name = "seat"}).value(),
                chair = model_.addClass({.name = "chair"}).value();
  ASSERT_TRUE(model_.mergeClasses(std::array{seat}, chair));
  ASSERT_TRUE(model_.hideClasses(std::array{chair}));
  const ClassImport done = import({{.id = chair, .name = "chair"}, {.id = seat, .name = "stool"}});
  EXPECT_FALSE(model_.classes().find(chair)->hidden);
  EXPECT_EQ(done.updated, 1);
  EXPECT_THAT(done.conflicts, ElementsAre(HasSubstr("merged into class 2")));
}

}  // namespace
}  // namespace scantrove
