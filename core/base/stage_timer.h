#pragma once
#include <chrono>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scantrove {

/// Median and 95th percentile of a set of durations.
struct DurationSummary {
  double median_ms = 0;
  double p95_ms = 0;
};

[[nodiscard]] DurationSummary summarize(std::vector<double> durations_ms);

/// Wall time of the named stages of the current frame, in call order, and of all frames. A long scan keeps at
/// most kMaxFrames, spread evenly over it. One thread.
class StageTimer {
 public:
  static constexpr std::size_t kMaxFrames = 8192;  ///< kept per stage

  struct Stage {
    std::string name;
    double last_ms = 0;
    std::vector<double> all_ms;
    std::vector<std::size_t> frames;  ///< frame numbers of `all_ms`, counted from 0
    std::size_t runs = 0;             ///< kept or not
    std::size_t every = 1;            ///< one of so many runs is kept

    /// Halves the stored samples and the rate of new ones.
    void thinOut();
  };

  /// Runs `work` as the stage `name` and returns what it returns.
  template <class Work>
  decltype(auto) time(std::string_view name, Work&& work) {
    const Scope scope(*this, name);
    return std::forward<Work>(work)();
  }

  /// Adds to a stage of the current frame (a stage may run in several pieces).
  void add(std::string_view name, double duration_ms);

  /// Ends the frame: stages that ran may gain an entry in `all_ms`.
  void endFrame();

  [[nodiscard]] const std::vector<Stage>& stages() const { return stages_; }

 private:
  class Scope {
   public:
    Scope(StageTimer& timer, std::string_view name)
        : timer_(timer), name_(name), start_(std::chrono::steady_clock::now()) {}
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;
    ~Scope() {
      const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start_;
      timer_.add(name_, elapsed.count());
    }

   private:
    StageTimer& timer_;
    std::string_view name_;
    std::chrono::steady_clock::time_point start_;
  };

  struct Pending {
    std::size_t stage;
    double duration_ms;
  };
  std::size_t indexOf(std::string_view name);

  std::vector<Stage> stages_;
  std::vector<Pending> pending_;
  std::size_t frames_ = 0;
};

/// A slow frame, and the stage that exceeded its own median most.
struct SlowFrame {
  std::size_t frame = 0;  ///< counted from 0
  double total_ms = 0;    ///< total of all stages
  std::string stage;
  double stage_ms = 0;
};

/// At most `most` frames, slowest first.
[[nodiscard]] std::vector<SlowFrame> slowestFrames(const std::vector<StageTimer::Stage>& stages,
                                                   std::size_t most);

}  // namespace scantrove
