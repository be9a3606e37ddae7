#include "core/base/label_name.h"

#include <gmock/gmock.h>

#include "core/base/text.h"

namespace scantrove::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(LabelName, DropsSurroundingBlanks) {
  EXPECT_EQ(*checkedLabelName(" a mug\t\n"), "a mug");
  EXPECT_EQ(*checkedLabelName("\xC2\xA0mug\xE3\x80\x80"), "mug");  // no-break space, ideographic space
  EXPECT_EQ(*checkedCategoryName("  cup "), "cup");
}

TEST(LabelName, KeepsLettersOfAnyScript) {
  for (const std::string name : {"Tasse \xC3\xA9", "\xE6\x9D\xAF", "\xF0\x9F\x8D\xB5", "4 mugs", "-1"}) {
    const Result<std::string> checked = checkedLabelName(name);
    ASSERT_TRUE(checked) << name;
    EXPECT_EQ(*checked, name);
  }
}

TEST(LabelName, RefusesNames_WhenNotUtf8) {
  for (const std::string name :
       {"\xFF\xFE", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "mug\xC3"})
    EXPECT_THAT(checkedLabelName(name).error().message(), HasSubstr("UTF-8"));
}

TEST(LabelName, RefusesNames_WhenEmptyLongOrWithControlCharacters) {
  EXPECT_FALSE(checkedLabelName(" \t"));
  EXPECT_THAT(checkedLabelName("two\nlines").error().message(), HasSubstr("control characters"));
  EXPECT_THAT(checkedLabelName("a\xE2\x80\xA8z").error().message(), HasSubstr("control characters"));
  EXPECT_THAT(checkedLabelName(std::string(300, 'x')).error().message(),
              AllOf(HasSubstr("300"), HasSubstr("200")));
  EXPECT_THAT(checkedLabelName("12").error().message(), HasSubstr("number alone"));
}

TEST(LabelName, CategoryMayBeEmptyOrANumber) {
  EXPECT_EQ(*checkedCategoryName(" "), "");
  EXPECT_EQ(*checkedCategoryName("12"), "12");
  EXPECT_FALSE(checkedCategoryName("two\nlines"));
  EXPECT_FALSE(checkedCategoryName(std::string(201, 'x')));
}

TEST(ForTerminal, ReplacesControlCharacters) {
  EXPECT_EQ(forTerminal("a\x1b[31mred\x07 \xC2\x9B"
                        "1m\nend"),
            "a?[31mred? ?1m\nend");
}

TEST(ForTerminal, CutsLongTextBetweenCharacters) {
  EXPECT_EQ(forTerminal("abc\xC3\xA9z", 4), "abc ...");
  EXPECT_EQ(forTerminal("abc\xC3\xA9z", 5), "abc\xC3\xA9 ...");
  EXPECT_EQ(forTerminal("abc", 3), "abc");
}

}  // namespace
}  // namespace scantrove::test
