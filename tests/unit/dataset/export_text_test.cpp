#include "core/dataset/export_text.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

TEST(XmlEscaped, LeavesNoMarkupAndNoControlCharacters) {
  EXPECT_EQ(xmlEscaped("a<b>&\"c\" 'd'"), "a&#60;b&#62;&#38;&#34;c&#34; &#39;d&#39;");
  EXPECT_EQ(xmlEscaped("two\r\nlines\tand a tab"), "two&#13;&#10;lines&#9;and a tab");
  EXPECT_EQ(xmlEscaped(std::string("nul\0bell\a", 9)), "nul\uFFFDbell\uFFFD");
  EXPECT_EQ(xmlEscaped("Gefäß 箱 📦"), "Gefäß 箱 📦");
  EXPECT_EQ(xmlEscaped("\xFF"), "\uFFFD");
}

TEST(SafeFileName, KeepsLettersAndReplacesSpecialCharacters) {
  EXPECT_EQ(safeFileName(12, "red cup"), "000012_red_cup");
  EXPECT_EQ(safeFileName(12, "Gefäß 箱 📦"), "000012_Gefäß_箱_📦");
  EXPECT_EQ(safeFileName(12, "../../etc/passwd"), "000012_.._.._etc_passwd");
  EXPECT_EQ(safeFileName(12, "a\nb\tc\"d'e\\f"), "000012_a_b_c_d_e_f");
  EXPECT_EQ(safeFileName(12, "a\u2028b\x7F"), "000012_a_b_");
  EXPECT_EQ(safeFileName(12, "dots... "), "000012_dots");
  EXPECT_EQ(safeFileName(12, ""), "000012");
  EXPECT_EQ(safeFileName(12, " . "), "000012");
  EXPECT_EQ(safeFileName(12, "  red  cup. "), "000012_red__cup");
  EXPECT_EQ(safeFileName(12, "a\u00A0b\u3000c\u2009d"), "000012_a_b_c_d") << "blanks of any language";
  EXPECT_EQ(safeFileName(1234567, "x"), "1234567_x");
  EXPECT_EQ(safeFileName(1, "a\xFF\xC3"), "000001_a__") << "not UTF-8";
}

TEST(SafeFileName, TruncatesBetweenCharacters) {
  std::string name;
  for (int i = 0; i < 100; ++i) name += "ß";
  EXPECT_EQ(safeFileName(1, name).size(), 7U + 80U);
  EXPECT_EQ(safeFileName(1, "x" + name).size(), 7U + 79U);
  EXPECT_EQ(validUtf8(safeFileName(1, "x" + name)), safeFileName(1, "x" + name));
}

TEST(ValidUtf8, ReplacesInvalidBytes) {
  EXPECT_EQ(validUtf8("Gefäß 箱 📦"), "Gefäß 箱 📦");
  EXPECT_EQ(validUtf8("a\xFFz"), "a\uFFFDz");
  EXPECT_EQ(validUtf8("a\xC3"), "a\uFFFD");
  EXPECT_EQ(validUtf8("\xC0\xAF"), "\uFFFD\uFFFD") << "a slash in two bytes";
  EXPECT_EQ(validUtf8("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD") << "half of a surrogate pair";
  EXPECT_EQ(validUtf8(std::string("a\0b", 3)), std::string("a\0b", 3));
}

TEST(YamlQuoted, EscapesSpecialCharacters) {
  EXPECT_EQ(yamlQuoted("red cup"), "\"red cup\"");
  EXPECT_EQ(yamlQuoted("say \"hi\" \\ no: #1"), "\"say \\\"hi\\\" \\\\ no: #1\"");
  EXPECT_EQ(yamlQuoted("a\nb\x85"), "\"a\\u000Ab\uFFFD\"");
  EXPECT_EQ(yamlQuoted("箱 📦"), "\"箱 📦\"");
  EXPECT_EQ(yamlQuoted("a\u2028b\u0085"), "\"a\\u2028b\\u0085\"");
}

TEST(OnOneLine, HasNoLineEnds) { EXPECT_EQ(onOneLine("a\r\nb\tc\u2029d"), "a  b c d"); }

TEST(JsonByLines, ParsesToTheSameJson) {
  const ExportJson json = {{"1", {{"a", {1, 2.5}}}}, {"2\n", "x"}};
  EXPECT_EQ(ExportJson::parse(jsonByLines(json)), json);
  EXPECT_EQ(jsonByLines(json), "{\n\"1\": {\"a\":[1,2.5]},\n\"2\\n\": \"x\"\n}\n");
  EXPECT_EQ(ExportJson::parse(jsonByLines(ExportJson::object())), ExportJson::object());
}

}  // namespace
}  // namespace scantrove
