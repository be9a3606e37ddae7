#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/child_process.h"

namespace scantrove::test {

inline std::vector<std::string> command(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), SCANTROVE_BINARY);
  return arguments;
}

/// `scantrove ARGUMENTS...`, run to its end.
inline Finished scantrove(const std::vector<std::string>& arguments,
                          const ChildProcess::Environment& environment = {}) {
  return runProgram(command(arguments), environment);
}

inline nlohmann::json jsonOf(const Finished& run) {
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return nlohmann::json::parse(run.out, nullptr, false);
}

/// Exit code 1, nothing on stdout, one message on stderr that contains all of `words`.
inline void expectJobFailure(const Finished& run, const std::vector<std::string>& words) {
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.out, "");
  EXPECT_THAT(run.err, testing::StartsWith("scantrove: "));
  for (const std::string& word : words) EXPECT_THAT(run.err, testing::HasSubstr(word));
}

/// Exit code 2, nothing on stdout, a message on stderr that contains all of `words`.
inline void expectWrongUsage(const Finished& run, const std::vector<std::string>& words) {
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_EQ(run.out, "");
  for (const std::string& word : words) EXPECT_THAT(run.err, testing::HasSubstr(word));
}

}  // namespace scantrove::test
