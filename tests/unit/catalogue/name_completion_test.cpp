#include "core/catalogue/name_completion.h"

#include <gmock/gmock.h>

namespace scantrove {
namespace {

using testing::HasSubstr;

class NameCompletionTest : public testing::Test {
 protected:
  ClassId addClass(const std::string& name) { return model_.addClass({.name = name}).value(); }
  ObjectId addObject(const std::string& name, ClassId class_id = {}) {
    const ObjectId id{static_cast<std::uint32_t>(model_.objects().size()) + 1};
    model_.put({id, name, NamedBy::user, true, false, {}, {class_id, {}}});
    return id;
  }
  [[nodiscard]] NameCompletion complete(const std::string& text) const {
    const Result<NameCompletion> completion = completeName(model_, text);
    EXPECT_TRUE(completion) << completion.error().message();
    return completion.value_or(NameCompletion{});
  }
  /// "name / class", with "?" after a class to be made.
  [[nodiscard]] std::string words(const std::string& text) const {
    const NameCompletion completion = complete(text);
    return completion.name + " / " + completion.class_name + (completion.class_id ? "" : "?");
  }

  CatalogueModel model_;
};

TEST_F(NameCompletionTest, MakesAClassOfTheText_WhenNothingIsKnown) {
  EXPECT_EQ(words("chair"), "chair / chair?");
  EXPECT_EQ(words("  red chair "), "red chair / red chair?");
  EXPECT_EQ(words("chair 2"), "chair 2 / chair?") << "without its number";
  EXPECT_FALSE(complete("chair").same);
}

TEST_F(NameCompletionTest, NumbersObjectsOfTheClassThatIsNamed) {
  const ClassId chair = addClass("chair");
  EXPECT_EQ(words("chair"), "chair / chair");
  const ObjectId first = addObject("chair", chair);
  EXPECT_EQ(words("chair"), "chair 2 / chair");
  EXPECT_EQ(complete("chair").same, first) << "the same chair, or another one";
  EXPECT_EQ(complete("chair").typed, "chair");
  addObject("chair 2", chair);
  addObject("chair 4", chair);
  EXPECT_EQ(words("chair"), "chair 3 / chair");
}

TEST_F(NameCompletionTest, KnowsTheClassOfANumberedName) {
  const ClassId chair = addClass("chair");
  EXPECT_EQ(words("chair 2"), "chair 2 / chair");
  EXPECT_EQ(complete("chair 2").class_id, chair);
  const ObjectId second = addObject("chair 2", chair);
  EXPECT_EQ(words("chair 2"), "chair 3 / chair");
  EXPECT_EQ(complete("chair 2").same, second);
}

TEST_F(NameCompletionTest, KnowsTheClassAtTheEndOfAName) {
  addClass("mug");
  addClass("table");
  addClass("coffee table");
  EXPECT_EQ(words("red mug"), "red mug / mug");
  EXPECT_EQ(words("red mug 3"), "red mug 3 / mug");
  EXPECT_EQ(words("big coffee table"), "big coffee table / coffee table") << "the longest one";
  EXPECT_EQ(words("smug"), "smug / smug?") << "whole words only";
  EXPECT_EQ(words("mug tree"), "mug tree / mug tree?");
}

TEST_F(NameCompletionTest, TakesTheClassBeforeASlash) {
  const ClassId cup = addClass("cup");
  addClass("mug");
  EXPECT_EQ(words("cup/red mug"), "red mug / cup");
  EXPECT_EQ(complete(" cup / red mug ").class_id, cup);
  EXPECT_EQ(words("vase/red mug"), "red mug / vase?");
  addObject("red mug");
  EXPECT_EQ(words("cup/red mug"), "red mug 2 / cup");
  EXPECT_EQ(words("/mug"), "/mug / /mug?") << "nothing is in front";
  EXPECT_EQ(words("mug/"), "mug/ / mug/?");
}

TEST_F(NameCompletionTest, OffersTheClassOfTheObjectThatHasTheName) {
  const ClassId furniture = addClass("furniture");
  const ObjectId chair = addObject("chair", furniture);
  EXPECT_EQ(words("chair"), "chair 2 / furniture");
  EXPECT_EQ(complete("chair").same, chair);
  addClass("chair");
  EXPECT_EQ(words("chair"), "chair 2 / chair") << "a class of that name comes first";
}

TEST_F(NameCompletionTest, NameOfTheObjectItselfIsFree) {
  const ObjectId chair = addObject("chair", addClass("seat"));
  addObject("table");
  const Result<NameCompletion> own = completeName(model_, "stool/chair", chair);
  ASSERT_TRUE(own);
  EXPECT_EQ(own->name, "chair");
  EXPECT_EQ(own->class_name, "stool");
  EXPECT_FALSE(own->same);
  EXPECT_EQ(completeName(model_, "table", chair)->name, "table 2");
}

TEST_F(NameCompletionTest, IgnoresHiddenObjectsAndClasses) {
  const ClassId chair = addClass("chair");
  const ObjectId object = addObject("chair", chair);
  ASSERT_TRUE(model_.remove({&object, 1}));
  ASSERT_TRUE(model_.hideClasses({&chair, 1}));
  EXPECT_EQ(words("chair"), "chair / chair?");
}

TEST_F(NameCompletionTest, Fails_WhenNameOrClassAreNotValid) {
  for (const char* text : {"", "  ", "12", "a\nb", "12/mug", "cup/12", "\xFF"})
    EXPECT_FALSE(completeName(model_, text)) << text;
  addObject(std::string(200, 'x'));
  EXPECT_THAT(completeName(model_, std::string(200, 'x')).error().what, HasSubstr("202 characters"));
}

TEST_F(NameCompletionTest, CompletesToWhatNamingDoes) {
  addClass("chair");
  addObject("chair");
  const ObjectId fresh = addObject("Obj_9");
  ObjectState unnamed = *model_.find(fresh);
  unnamed.named_by = NamedBy::program;
  unnamed.confirmed = false;
  model_.put(unnamed);
  const NameCompletion completion = complete("chair");
  const ObjectNaming naming = model_.nameByUser(fresh, completion.name, completion.class_name).value();
  EXPECT_EQ(naming.object, fresh) << "another chair, not the same one";
  EXPECT_EQ(model_.find(fresh)->name, "chair 2");
}

}  // namespace
}  // namespace scantrove
