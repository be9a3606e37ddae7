#include "tools/train/samples.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>

#include "core/base/text.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/training/made_samples.h"

namespace scantrove::train {
namespace {

using test::madeSamples;
using testing::HasSubstr;

std::string errorOf(std::string_view text) {
  const auto samples = parseSamples(text, "samples/room-7-hard.txt");
  return samples ? "no error" : samples.error().message();
}

void expectEqual(const std::vector<float>& a, const std::vector<float>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_TRUE(a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i]))) << i << ": " << a[i] << ", " << b[i];
}

TEST(Samples, AreReadAsTheyWereWritten) {
  const test::TemporaryFolder folder;
  const SceneSamples written = madeSamples();
  ASSERT_TRUE(writeSamples(folder / "one.txt", written));
  const auto read = readSamples(folder / "one.txt");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->origin, written.origin);
  ASSERT_EQ(read->objectness.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read->objectness[i].regions, written.objectness[i].regions);
    EXPECT_EQ(read->objectness[i].frame, written.objectness[i].frame);
    EXPECT_EQ(read->objectness[i].object, written.objectness[i].object);
    EXPECT_EQ(read->objectness[i].overlap, written.objectness[i].overlap);
    expectEqual(read->objectness[i].x, written.objectness[i].x);
  }
  ASSERT_EQ(read->borders.size(), 1U);
  EXPECT_TRUE(read->borders[0].is_same_object);
  expectEqual(read->borders[0].x, written.borders[0].x);
}

TEST(Samples, HaveTheDocumentedLayout) {
  const std::string text = textOf(madeSamples());
  const std::vector<std::string_view> lines = splitLines(text);
  ASSERT_EQ(lines.size(), 10U);
  EXPECT_EQ(lines[0], "scantrove samples 2");
  EXPECT_EQ(lines[1], "scene room:7:hard");
  EXPECT_EQ(lines[2], "frames 30");
  EXPECT_EQ(lines[3], "commit abc123");
  EXPECT_THAT(std::string(lines[4]), testing::MatchesRegex("objectness log_pixels open .* support carried"));
  EXPECT_THAT(std::string(lines[5]), testing::MatchesRegex("borders observations .* outlined_part"));
  EXPECT_EQ(lines[6].substr(0, 37), "o 12 5 0.75 2 3 14 0.5 1.5 nan 3.5 4.");
  EXPECT_EQ(lines[7].substr(0, 29), "o 12 0 0 1 9 -1e-07 1.5 nan 3");
  EXPECT_EQ(lines[8].substr(0, 16), "b 1 -0.1 nan 1.9");
  EXPECT_EQ(lines[9].substr(0, 4), "end ");
  EXPECT_EQ(lines[9].size(), 12U);
}

TEST(Samples, NameTheDamagedFile_WhateverByteIsDamaged) {
  const std::string text = textOf(madeSamples());
  for (std::size_t at = 0; at < text.size(); ++at) {
    std::string damaged = text;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    EXPECT_THAT(errorOf(damaged), HasSubstr("samples/room-7-hard.txt")) << "at " << at;
  }
  EXPECT_EQ(errorOf(text.substr(0, text.size() - 40)),
            "samples/room-7-hard.txt is damaged. Delete it; the scene is scanned again.");
}

TEST(Samples, NameTheFile_WhereverItEnds) {
  const std::string text = textOf(madeSamples());
  for (std::size_t size = 0; size < text.size(); ++size)
    EXPECT_THAT(errorOf(text.substr(0, size)), HasSubstr("samples/room-7-hard.txt")) << size << " bytes";
}

/// The samples with one text replaced, and a last line that confirms it.
std::string confirmedWith(const std::string& from, const std::string& to) {
  std::string text = textOf(madeSamples());
  text.replace(text.find(from), from.size(), to);
  // CRC-32 (IEEE 802.3), bit by bit.
  text.resize(text.rfind("end "));
  std::uint32_t crc = ~0U;
  for (const char byte : text) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  char last[16];
  std::snprintf(last, sizeof last, "end %08x\n", ~crc);
  return text + last;
}

TEST(Samples, AreRefused_WhenALineIsNotAsDocumented) {
  ASSERT_EQ(errorOf(confirmedWith("o 12 5", "o 13 5")), "no error");
  for (const auto& [from, to] :
       std::initializer_list<std::pair<const char*, const char*>>{{"o 12 5", "o twelve 5"},
                                                                  {"o 12 5", "x 12 5"},
                                                                  {"2 3 14", "3 3 14"},
                                                                  {"2 3 14", "99999999999 3 14"},
                                                                  {" 1.5 nan", " 1.5 inf"},
                                                                  {" 1.5 nan", " nan"},
                                                                  {" 1.5 nan", " 1.5 1.5 nan"},
                                                                  {"b 1 ", "b 2 "},
                                                                  {"frames 30", "frames many"},
                                                                  {"scene room:7:hard", "room:7:hard"}}) {
    EXPECT_THAT(errorOf(confirmedWith(from, to)), HasSubstr("is damaged")) << from << " -> " << to;
  }
}

TEST(Samples, AreRefused_WhenTheyHoldOtherFeatures) {
  EXPECT_EQ(
      errorOf(confirmedWith(" unoutlined", "")),
      "samples/room-7-hard.txt holds samples of other features than the program computes. Delete it; the "
      "scene is scanned again.");
  EXPECT_THAT(errorOf("log_pixels open | observations\n"), HasSubstr("no file of samples"));
}

}  // namespace
}  // namespace scantrove::train
