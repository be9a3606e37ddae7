// Writes the seeds to a folder and passes it to libFuzzer as the last corpus folder.
#include <fstream>

#include "tests/fuzz/fuzz_target.h"
#include "tests/support/temporary_folder.h"

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  using namespace scantrove::test;
  static const TemporaryFolder folder;
  static std::string path = folder.path().string();
  int number = 0;
  for (const std::string& seed : seeds()) folder.write("seed-" + std::to_string(number++), seed);
  static std::vector<char*> arguments(*argv, *argv + *argc);
  arguments.push_back(path.data());
  *argc = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  *argv = arguments.data();
  return 0;
}
