// Stored records of the map: packed words and the page in them.
#include <cstring>

#include "core/fusion/packed_words.h"
#include "core/fusion/stored_page.h"
#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {
namespace {

constexpr std::uint32_t kUnpackedSeed = 4096;

std::string textOf(const std::vector<std::uint32_t>& words) {
  return {reinterpret_cast<const char*>(words.data()), words.size() * sizeof(std::uint32_t)};
}

std::vector<std::uint32_t> wordsOf(std::string_view bytes) {
  std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
  if (!words.empty()) std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint32_t));
  return words;
}

StoredPage somePage() {
  StoredPage page;
  page.cells.fill(PAGE_EMPTY_CUBE(0));
  page.cells[3] = 0;
  page.bricks[3] = true;
  page.bricks[9] = page.inactive[9] = true;
  page.contents = BrickContents(2);
  for (std::size_t i = 0; i < page.contents.voxels(); i += 7) {
    page.contents.weights[i] = 9;
    page.contents.distances[i] = static_cast<cl_short>(i);
    page.contents.labels[i] = 77;
  }
  return page;
}

}  // namespace

std::vector<std::string> seeds() {
  const std::vector<std::uint32_t> words = somePage().toWords();
  const PackedWords packed = packWords(words);
  const auto unpacked = static_cast<std::uint32_t>(packed.unpacked_bytes);
  return {"P" + textOf(words),
          "L" + textOf({unpacked}) + std::string(packed.bytes.begin(), packed.bytes.end()),
          "L" + textOf({kUnpackedSeed}) + std::string(64, '\x11')};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  std::vector<std::uint32_t> words = test::wordsOf(input.substr(input.empty() ? 0 : 1));
  if (input.starts_with('L') && !words.empty()) {
    PackedWords packed;
    const std::string_view bytes = input.substr(1 + sizeof(std::uint32_t));
    // Limits the claimed size, because a fuzzer has little memory.
    packed.unpacked_bytes = words.front() % (1U << 24U);
    packed.bytes.assign(bytes.begin(), bytes.end());
    packed.checksum = checksumOf(packed.bytes);
    const auto unpacked = unpackWords(packed);
    test::require(!unpacked || unpacked->size() * sizeof(std::uint32_t) == packed.unpacked_bytes,
                  "unpacked words have the stated size");
    words = unpacked.value_or(std::vector<std::uint32_t>());
  }
  const auto page = StoredPage::fromWords(words);
  if (!page) return 0;
  test::require(page->contents.voxels() == page->bricks.count() * BRICK_VOXELS, "bricks have their voxels");
  const auto again = StoredPage::fromWords(page->toWords());
  test::require(again && again->contents == page->contents, "a page that is read can be written");
  return 0;
}
