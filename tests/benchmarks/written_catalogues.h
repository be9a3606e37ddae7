#pragma once
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <utility>

namespace scantrove::benchmarks {

/// Catalogues for benchmarks, by their number of views. Each is written once, into a temporary folder that is
/// removed at the program's end.
class WrittenCatalogues {
 public:
  using Write = std::function<void(const std::string& file, int views)>;

  explicit WrittenCatalogues(Write write) : write_(std::move(write)) {}
  WrittenCatalogues(const WrittenCatalogues&) = delete;
  WrittenCatalogues& operator=(const WrittenCatalogues&) = delete;
  ~WrittenCatalogues() { std::filesystem::remove_all(folder_); }

  [[nodiscard]] const std::string& of(int views) {
    std::string& file = files_[views];
    if (file.empty()) {
      std::filesystem::create_directories(folder_);
      file = folder_ / (std::to_string(views) + ".sqlite");
      write_(file, views);
    }
    return file;
  }

 private:
  Write write_;
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("scantrove-benchmark-" + std::to_string(::getpid()));
  std::map<int, std::string> files_;
};

/// Of this process, in megabytes.
inline double residentMemory_mb() {
  std::ifstream statm("/proc/self/statm");
  double pages = 0;
  statm >> pages >> pages;
  return pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e6;
}

}  // namespace scantrove::benchmarks
