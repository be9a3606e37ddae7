#include "core/fusion/brick_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numeric>
#include <random>

#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using testing::HasSubstr;

std::vector<std::uint32_t> randomWords(std::size_t count, unsigned seed, std::uint32_t mask = ~0U) {
  std::mt19937 random(seed);
  std::vector<std::uint32_t> words(count);
  for (std::uint32_t& word : words) word = static_cast<std::uint32_t>(random()) & mask;
  return words;
}

TEST(BrickStore, ReadsRecordsBack_AmongOtherInsertionsAndErasures) {
  const test::TemporaryFolder folder;
  BrickStore store(folder.path());
  std::vector<std::pair<BrickStore::Record, std::vector<std::uint32_t>>> stored;
  std::mt19937 random(3);
  for (unsigned step = 0; step < 600; ++step) {
    if (stored.size() > 40 || (!stored.empty() && random() % 3 == 0)) {
      const auto erased = stored.begin() + static_cast<std::ptrdiff_t>(random() % stored.size());
      store.erase(erased->first);
      stored.erase(erased);
    } else {
      // Half of the records compress.
      std::vector<std::uint32_t> words = randomWords(1 + random() % 9000, step, step % 2 == 0 ? ~0U : 7U);
      const auto record = store.put(words);
      ASSERT_TRUE(record) << record.error().message();
      stored.emplace_back(*record, std::move(words));
    }
    for (const auto& [record, words] : stored) {
      if (random() % 8 != 0) continue;
      const auto found = store.get(record);
      ASSERT_TRUE(found) << found.error().message();
      ASSERT_EQ(*found, words);
    }
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "a named file would remain after a crash";
}

TEST(BrickStore, CompressesSimilarVoxels) {
  const test::TemporaryFolder folder;
  BrickStore store(folder.path());
  // As in voxels, the high bytes are similar and the low bytes vary.
  std::vector<std::uint32_t> words = randomWords(100000, 1, 0xffU);
  for (std::uint32_t& word : words) word |= 0x12345600U;
  ASSERT_TRUE(store.put(words));
  EXPECT_LT(store.usedBytes(), 120000U);
}

TEST(BrickStore, ReusesErasedSpace) {
  const test::TemporaryFolder folder;
  BrickStore store(folder.path());
  std::vector<BrickStore::Record> records;
  for (unsigned i = 0; i < 30; ++i) records.push_back(store.put(randomWords(5000, i)).value());
  const std::uint64_t full = store.fileBytes();
  const std::uint64_t used = store.usedBytes();
  EXPECT_EQ(full, used);
  for (unsigned round = 0; round < 20; ++round) {
    for (std::size_t i = round % 3; i < records.size(); i += 3) store.erase(records[i]);
    EXPECT_LT(store.usedBytes(), used);
    for (std::size_t i = round % 3; i < records.size(); i += 3)
      records[i] = store.put(randomWords(5000, 100 * round + static_cast<unsigned>(i))).value();
    ASSERT_EQ(store.fileBytes(), full) << "gaps of the same size were not reused";
  }
  // Adjacent gaps merge, and the file ends after its last record.
  for (const BrickStore::Record& record : records) store.erase(record);
  EXPECT_EQ(store.usedBytes(), 0U);
  EXPECT_EQ(store.fileBytes(), 0U);
}

TEST(BrickStore, KeepsRecordsAndAcceptsSmallerOnes_WhenTheDiskIsFull) {
  const test::TemporaryFolder folder;
  BrickStore store(folder.path(), 65536);
  const std::vector<std::uint32_t> words = randomWords(10000, 1);
  const auto first = store.put(words);
  ASSERT_TRUE(first) << first.error().message();
  const auto second = store.put(randomWords(10000, 2));
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().what, HasSubstr("No space left"));
  EXPECT_THAT(second.error().what, HasSubstr(folder.path().string()));
  EXPECT_THAT(second.error().advice, HasSubstr("TMPDIR"));
  EXPECT_EQ(store.get(*first).value(), words);
  const std::vector<std::uint32_t> few = randomWords(2000, 3);
  const auto third = store.put(few);
  ASSERT_TRUE(third);
  EXPECT_EQ(store.get(*third).value(), few);
  EXPECT_EQ(store.get(*first).value(), words);
}

TEST(BrickStore, NamesTheFolder_WhenItDoesNotExist) {
  const test::TemporaryFolder folder;
  BrickStore store(folder.path() / "nowhere");
  const auto record = store.put(randomWords(10, 1));
  ASSERT_FALSE(record);
  EXPECT_THAT(record.error().what, HasSubstr("nowhere"));
  EXPECT_THAT(record.error().what, HasSubstr("No such file or directory"));
}

TEST(BrickStore, RefusesDamagedRecords) {
  const test::TemporaryFolder folder;
  BrickStore store(folder.path());
  const auto a = store.put(randomWords(3000, 1)).value();
  const auto b = store.put(randomWords(3000, 2)).value();
  BrickStore::Record wrong = a;
  wrong.offset = b.offset;  // as if the disk returned other data
  EXPECT_FALSE(store.get(wrong));
  wrong = a;
  wrong.checksum ^= 1;
  EXPECT_FALSE(store.get(wrong));
  wrong = a;
  wrong.bytes -= 4;
  EXPECT_FALSE(store.get(wrong));
  wrong = b;
  wrong.offset += std::uint64_t{1} << 30U;  // beyond the end
  const auto beyond = store.get(wrong);
  ASSERT_FALSE(beyond);
  EXPECT_THAT(beyond.error().what, HasSubstr("cannot be read back"));
  EXPECT_TRUE(store.get(a));
}

}  // namespace
}  // namespace scantrove
