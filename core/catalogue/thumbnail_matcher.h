#pragma once
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/thumbnail.h"
#include "core/compute/buffer.h"
#include "core/compute/compute_context.h"

namespace scantrove {

/// The thumbnails of all views on the device, and the kernels that compare queries with some of them
/// (kernels/warp_queries.cl, kernels/match_thumbnails.cl). Views are identified by index, 0 .. size() - 1.
/// The context's thread; all but create may throw cl::Error.
class ThumbnailMatcher {
 public:
  struct Pair {
    int query = 0;
    int view = 0;
  };

  [[nodiscard]] static Result<ThumbnailMatcher> create(ComputeContext& compute);

  [[nodiscard]] int size() const { return size_; }
  /// Reserves room for so many views; beyond it the buffers are copied into larger ones.
  void reserve(int views);
  /// The new view's index is the old size(). Views go to the device in batches, at the latest before a
  /// comparison.
  void append(const Thumbnail& thumbnail);
  void clear();

  /// Warped distance of each pair, in order; 0 = same, 2 = unrelated. One batch.
  [[nodiscard]] std::vector<float> distances(const std::vector<Thumbnail>& queries,
                                             const std::vector<Pair>& pairs);

 private:
  explicit ThumbnailMatcher(ComputeContext& compute) : compute_(&compute) {}
  void writeAppended();
  void prepareQueries(const std::vector<Thumbnail>& queries);

  ComputeContext* compute_;
  Kernel warp_queries_, shrink_queries_, score_warps_, refine_matches_;
  int size_ = 0, capacity_ = 0;
  std::vector<cl_char> appended_fine_, appended_coarse_;  // newest views, not on the device yet
  Buffer<cl_char> fine_views_, coarse_views_;
  int query_capacity_ = 0;
  Buffer<cl_char> queries_, fine_queries_, coarse_queries_;
  Buffer<cl_int2> pairs_;
  Buffer<cl_float> scores_, distances_;
};

}  // namespace scantrove
