#include "core/capture/time_association.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

namespace scantrove {

namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// Unpaired elements of equal time in one list: positions `first` to `end`.
struct Group {
  double time_s = 0;
  bool is_of_a = false;
  std::size_t first = 0, end = 0;
  std::size_t previous = kNone, next = kNone;  ///< non-empty neighbours in time
};

/// First elements of two neighbouring groups.
struct Candidate {
  double distance_s = 0;
  std::size_t in_a = 0, in_b = 0;      ///< positions
  std::size_t earlier = 0, later = 0;  ///< groups

  bool operator>(const Candidate& other) const {
    return std::tie(distance_s, in_a, in_b) > std::tie(other.distance_s, other.in_a, other.in_b);
  }
};

/// The closest pair lies in two adjacent groups: an element between them would be closer to one of both. So
/// only neighbours are candidates, at most three new ones for each pair.
class TimeAssociation {
 public:
  TimeAssociation(const std::vector<double>& a, const std::vector<double>& b, double tolerance_s)
      : tolerance_s_(tolerance_s) {
    for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
      const double time_s = j == b.size() || (i < a.size() && a[i] < b[j]) ? a[i] : b[j];
      for (; i < a.size() && j < b.size() && a[i] == time_s && b[j] == time_s; ++i, ++j)
        pairs_.emplace_back(i, j);
      i = addGroup(a, time_s, i, true);
      j = addGroup(b, time_s, j, false);
    }
  }

  std::vector<std::pair<std::size_t, std::size_t>> run() {
    for (std::size_t group = 1; group < groups_.size(); ++group) consider(group - 1, group);
    while (!candidates_.empty()) {
      const Candidate closest = candidates_.top();
      candidates_.pop();
      if (isPresent(closest)) take(closest);
    }
    std::sort(pairs_.begin(), pairs_.end());
    return std::move(pairs_);
  }

 private:
  /// Adds a group of the elements from `first` on that have this time. Returns the position after them.
  std::size_t addGroup(const std::vector<double>& times, double time_s, std::size_t first, bool is_of_a) {
    std::size_t end = first;
    while (end < times.size() && times[end] == time_s) ++end;
    if (end == first) return end;
    const std::size_t previous = groups_.empty() ? kNone : groups_.size() - 1;
    if (previous != kNone) groups_[previous].next = groups_.size();
    groups_.push_back({time_s, is_of_a, first, end, previous, kNone});
    return end;
  }

  void consider(std::size_t earlier, std::size_t later) {
    if (earlier == kNone || later == kNone) return;
    const Group& one = groups_[earlier];
    const Group& other = groups_[later];
    if (one.is_of_a == other.is_of_a) return;
    const Group& of_a = one.is_of_a ? one : other;
    const Group& of_b = one.is_of_a ? other : one;
    if (of_b.time_s < of_a.time_s - tolerance_s_ || of_b.time_s > of_a.time_s + tolerance_s_) return;
    candidates_.push({std::abs(of_a.time_s - of_b.time_s), of_a.first, of_b.first, earlier, later});
  }

  /// Whether both elements are still the first ones of neighbouring groups.
  [[nodiscard]] bool isPresent(const Candidate& candidate) const {
    const Group& one = groups_[candidate.earlier];
    const Group& other = groups_[candidate.later];
    const Group& of_a = one.is_of_a ? one : other;
    const Group& of_b = one.is_of_a ? other : one;
    return one.next == candidate.later && one.first < one.end && other.first < other.end &&
           of_a.first == candidate.in_a && of_b.first == candidate.in_b;
  }

  void take(const Candidate& closest) {
    pairs_.emplace_back(closest.in_a, closest.in_b);
    const std::size_t before = groups_[closest.earlier].previous, after = groups_[closest.later].next;
    const bool earlier_is_left = removeFirst(closest.earlier), later_is_left = removeFirst(closest.later);
    consider(earlier_is_left ? closest.earlier : before, later_is_left ? closest.later : after);
    if (earlier_is_left) consider(before, closest.earlier);
    if (later_is_left) consider(closest.later, after);
  }

  /// Returns whether the group has elements left; otherwise it is unlinked.
  bool removeFirst(std::size_t number) {
    Group& group = groups_[number];
    if (++group.first < group.end) return true;
    if (group.previous != kNone) groups_[group.previous].next = group.next;
    if (group.next != kNone) groups_[group.next].previous = group.previous;
    return false;
  }

  double tolerance_s_;
  std::vector<Group> groups_;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> candidates_;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;
};

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> associateTimes(const std::vector<double>& a,
                                                                const std::vector<double>& b,
                                                                double tolerance_s) {
  return TimeAssociation(a, b, tolerance_s).run();
}

}  // namespace scantrove
