// Runs the linked fuzz target without a fuzzer: its seeds, then 2,000 fixed mutations of them (CMakeLists.txt
// lists exceptions). A failure aborts the program; its input stays in the printed file.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/mutation.h"

namespace scantrove::test {
namespace {

constexpr int kMutations = SCANTROVE_FUZZ_MUTATIONS;

class InputFile {
 public:
  InputFile()
      : path_(std::filesystem::temp_directory_path() / ("scantrove-fuzz-" SCANTROVE_FUZZ_TARGET "-input")) {
    std::printf("The input of a crash stays in %s\n", path_.c_str());
    std::fflush(stdout);
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile() { std::filesystem::remove(path_); }

  void run(const std::string& input) const {
    std::filesystem::remove(path_);  // some file systems flush a file that is overwritten
    std::ofstream(path_, std::ios::binary) << input;
    ASSERT_EQ(LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size()), 0);
  }

 private:
  std::filesystem::path path_;
};

TEST(Fuzz, TargetReadsOrRefusesSeedsAndMutations) {
  const InputFile file;
  const std::vector<std::string> corpus = seeds();
  ASSERT_FALSE(corpus.empty());
  for (const std::string& seed : corpus) file.run(seed);
  if (const char* seconds = std::getenv("SCANTROVE_FUZZ_SECONDS")) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(std::atoi(seconds));
    Mutator others(corpus, std::random_device{}());
    long count = 0;
    for (; std::chrono::steady_clock::now() < end; ++count) file.run(others.next());
    std::printf("%ld mutations\n", count);
    return;
  }
  Mutator mutator(corpus, 20240229);
  for (int i = 0; i < kMutations; ++i) file.run(mutator.next());
}

}  // namespace
}  // namespace scantrove::test
