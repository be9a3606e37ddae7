#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// Raw label -> region. Voxels hold raw labels, which never change their number; joining two regions is one
/// entry here and reaches every voxel, seen or not. A region is named by its root label. Every join stands in
/// a log and can be undone and redone; the table is always what replaying the log gives. One thread.
class LabelTable {
 public:
  enum class Cause { algorithm, person };
  struct Join {
    RegionId into;
    RegionId from;
    Cause cause = Cause::algorithm;
    int frame = 0;
  };

  /// A raw label that no voxel holds yet: a region of its own.
  RegionId newLabel();

  /// Region of a raw label. 0 stays 0.
  [[nodiscard]] RegionId regionOf(std::uint32_t label) const;

  /// Joins the regions of two labels; `into` gives the name. False when they are one already.
  bool join(RegionId into, RegionId from, Cause cause, int frame);

  /// Takes the newest join back, or puts it on again. False when there is none. Joins after an undo forget
  /// what could be redone.
  bool undo();
  bool redo();

  [[nodiscard]] std::span<const Join> log() const { return {log_.data(), done_}; }

  /// Region of every raw label, by raw label, [0] = 0. Valid until the next change.
  [[nodiscard]] const std::vector<std::uint32_t>& regionOfLabel() const;

  /// Grows with every change of an existing label's region: tells whether copies are stale.
  [[nodiscard]] std::uint64_t version() const { return version_; }
  [[nodiscard]] std::uint32_t labelCount() const { return static_cast<std::uint32_t>(parents_.size()) - 1; }

 private:
  [[nodiscard]] std::uint32_t find(std::uint32_t label) const;
  void replay();

  mutable std::vector<std::uint32_t> parents_{0};  // path compression changes it, never its meaning
  mutable std::vector<std::uint32_t> flat_{0};
  mutable bool flat_is_current_ = true;
  std::vector<Join> log_;
  std::size_t done_ = 0;  // joins of log_ that are in force
  std::uint64_t version_ = 0;
};

}  // namespace scantrove
