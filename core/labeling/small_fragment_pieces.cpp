#include "core/labeling/small_fragment_pieces.h"

#include <algorithm>
#include <unordered_map>

namespace scantrove {
namespace {

/// Consecutive pixels of one fragment in a row.
struct Run {
  int begin, end;  // pixels of the image
  FragmentId fragment;
  std::uint32_t parent;  // run of the same component; itself if it is the first
  int piece_px = 0;      // set for a component's first run
};

class Pieces {
 public:
  Pieces(std::span<const FragmentId> fragments, int width) {
    const int pixels = static_cast<int>(fragments.size());
    std::size_t above = 0;  // first run that may lie above the next one
    for (int row = 0; row < pixels; row += width) {
      const std::size_t first_of_row = runs_.size();
      for (int begin = row; begin < row + width;) {
        const FragmentId fragment = fragments[static_cast<std::size_t>(begin)];
        int end = begin + 1;
        while (end < row + width && fragments[static_cast<std::size_t>(end)] == fragment) ++end;
        if (fragment)
          add({begin, end, fragment, static_cast<std::uint32_t>(runs_.size())}, width, above, first_of_row);
        begin = end;
      }
      above = first_of_row;
    }
    for (Run& run : runs_) runs_[find(run.parent)].piece_px += run.end - run.begin;
  }

  [[nodiscard]] const std::vector<Run>& runs() const { return runs_; }
  [[nodiscard]] int sizeOf(const Run& run) { return runs_[find(run.parent)].piece_px; }

 private:
  void add(const Run& run, int width, std::size_t& above, std::size_t first_of_row) {
    runs_.push_back(run);
    const int from = run.begin - width, to = run.end - width;
    while (above < first_of_row && runs_[above].end <= from) ++above;
    for (std::size_t other = above; other < first_of_row && runs_[other].begin < to; ++other) {
      if (runs_[other].fragment == run.fragment)
        unite(static_cast<std::uint32_t>(other), static_cast<std::uint32_t>(runs_.size() - 1));
    }
  }
  std::uint32_t find(std::uint32_t run) {
    while (runs_[run].parent != run) run = runs_[run].parent = runs_[runs_[run].parent].parent;
    return run;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    runs_[std::max(a, b)].parent = std::min(a, b);
  }

  std::vector<Run> runs_;
};

}  // namespace

std::vector<FragmentId> withoutSmallPieces(std::span<const FragmentId> fragments, int width, int least_px) {
  Pieces pieces(fragments, width);
  std::unordered_map<FragmentId, int> largest_px;
  for (const Run& run : pieces.runs()) {
    int& largest = largest_px[run.fragment];
    largest = std::max(largest, pieces.sizeOf(run));
  }
  std::vector<FragmentId> clean(fragments.begin(), fragments.end());
  for (const Run& run : pieces.runs()) {
    const int size = pieces.sizeOf(run);
    if (size < least_px && size < largest_px.at(run.fragment))
      std::fill(clean.begin() + run.begin, clean.begin() + run.end, FragmentId{});
  }
  return clean;
}

}  // namespace scantrove
