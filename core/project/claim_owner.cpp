#include "core/project/claim_owner.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <system_error>

#include "core/base/regular_file.h"
#include "core/base/text.h"

namespace scantrove {
namespace {

using ClaimJson = nlohmann::ordered_json;

constexpr const char* kClaimVersionKey = "scantrove_claim";

/// The boot and the numbering of processes: containers of one host number theirs apart.
std::string thisMachine() {
  const Result<std::string> boot = readFile("/proc/sys/kernel/random/boot_id", 64);
  std::error_code failure;
  const std::filesystem::path numbering = std::filesystem::read_symlink("/proc/self/ns/pid", failure);
  if (!boot || failure) return {};
  return std::string(trimmed(*boot)) + " " + numbering.string();
}

struct RunningProcess {
  char state = '?';
  std::string start;
};

/// Fields 3 and 22 of /proc/PID/stat; empty: no such process.
std::optional<RunningProcess> runningProcess(long process) {
  const Result<std::string> stat = readFile("/proc/" + std::to_string(process) + "/stat", 4096);
  if (!stat) return std::nullopt;
  const std::size_t name_end = stat->rfind(')');  // the name may contain blanks and brackets
  if (name_end == std::string::npos) return std::nullopt;
  std::istringstream fields(stat->substr(name_end + 1));
  RunningProcess running;
  fields >> running.state;
  constexpr int kStartField = 22;
  for (int field = 4; field <= kStartField; ++field) fields >> running.start;
  return running;
}

std::string secondNow() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc)};
}

std::string randomToken() {
  std::random_device random;
  std::ostringstream token;
  token << std::hex << random() << '-' << random() << '-' << ::getpid();
  return token.str();
}

}  // namespace

std::string ClaimOwner::describe() const {
  return (host.empty() ? "an unknown computer" : host) + ", process " + std::to_string(process);
}

ClaimOwner thisClaimOwner() {
  utsname system{};
  const bool is_named = ::uname(&system) == 0;
  const long process = ::getpid();
  const std::optional<RunningProcess> running = runningProcess(process);
  return {is_named ? system.nodename : "", thisMachine(), process,
          running ? running->start : "",   secondNow(),   randomToken()};
}

bool hasEnded(const ClaimOwner& owner) {
  if (owner.machine.empty() || owner.machine != thisMachine()) return false;
  const std::optional<RunningProcess> running = runningProcess(owner.process);
  if (!running || running->state == 'Z' || running->state == 'X') return true;
  return running->start != owner.process_start;
}

std::string toClaimText(const ClaimOwner& owner, const std::string& source) {
  const ClaimJson json{{kClaimVersionKey, 1},      {"recording", source},
                       {"host", owner.host},       {"machine", owner.machine},
                       {"process", owner.process}, {"process_start", owner.process_start},
                       {"since", owner.since},     {"token", owner.token}};
  return json.dump(1, ' ', false, ClaimJson::error_handler_t::replace) + "\n";
}

std::optional<ClaimOwner> claimOwnerFrom(const std::string& text) {
  const ClaimJson json = ClaimJson::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains(kClaimVersionKey)) return std::nullopt;
  const auto word = [&](const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  const auto process = json.find("process");
  if (process == json.end() || !process->is_number_integer()) return std::nullopt;
  ClaimOwner owner{word("host"),          word("machine"), process->get<long>(),
                   word("process_start"), word("since"),   word("token")};
  if (owner.token.empty()) return std::nullopt;
  return owner;
}

}  // namespace scantrove
