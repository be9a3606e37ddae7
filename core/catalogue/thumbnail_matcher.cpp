#include "core/catalogue/thumbnail_matcher.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/catalogue/kernels/thumbnail_layout.h"
#include "embedded/catalogue_kernels.h"

namespace scantrove {
namespace {

static_assert(sizeof(Thumbnail::fine) == FINE_VIEW_BYTES && sizeof(Thumbnail::coarse) == COARSE_VIEW_BYTES);

constexpr int kViewsOfABatch = 256;

std::size_t count(int items, int bytes) {
  return static_cast<std::size_t>(items) * static_cast<std::size_t>(bytes);
}

// Group sizes are fixed, because PoCL builds a kernel anew for each size.
const cl::NDRange kWarpGroup(FINE_SIDE, 4, 1), kShrinkGroup(COARSE_SIDE, 4, 1),
    kScoreGroup(THUMBNAIL_WARPS, 1), kRefineGroup(4);

cl::NDRange range(int x, int y, int z) {
  return {static_cast<std::size_t>(x), static_cast<std::size_t>(y), static_cast<std::size_t>(z)};
}

}  // namespace

Result<ThumbnailMatcher> ThumbnailMatcher::create(ComputeContext& compute) {
  ThumbnailMatcher matcher(compute);
  SCANTROVE_TRY(moveInto(matcher.warp_queries_, compute.kernel(kernels::catalogue, "warp_queries")));
  SCANTROVE_TRY(moveInto(matcher.shrink_queries_, compute.kernel(kernels::catalogue, "shrink_queries")));
  SCANTROVE_TRY(moveInto(matcher.score_warps_, compute.kernel(kernels::catalogue, "score_warps")));
  SCANTROVE_TRY(moveInto(matcher.refine_matches_, compute.kernel(kernels::catalogue, "refine_matches")));
  return matcher;
}

void ThumbnailMatcher::reserve(int views) {
  if (views <= capacity_) return;
  writeAppended();
  const auto grow = [&](Buffer<cl_char>& buffer, int bytes) {
    Buffer<cl_char> larger(compute_->context(), count(views, bytes));
    if (size_ > 0) {
      compute_->queue().enqueueCopyBuffer(buffer.cl(), larger.cl(), 0, 0, count(size_, bytes));
      compute_->finish();
    }
    buffer = std::move(larger);
  };
  grow(fine_views_, FINE_VIEW_BYTES);
  grow(coarse_views_, COARSE_VIEW_BYTES);
  capacity_ = views;
}

void ThumbnailMatcher::append(const Thumbnail& thumbnail) {
  if (size_ == capacity_) reserve(std::max(64, capacity_ + capacity_ / 2));
  appended_fine_.insert(appended_fine_.end(), thumbnail.fine.begin(), thumbnail.fine.end());
  appended_coarse_.insert(appended_coarse_.end(), thumbnail.coarse.begin(), thumbnail.coarse.end());
  ++size_;
  if (appended_fine_.size() >= count(kViewsOfABatch, FINE_VIEW_BYTES)) writeAppended();
}

void ThumbnailMatcher::writeAppended() {
  const int on_device = size_ - static_cast<int>(appended_fine_.size() / FINE_VIEW_BYTES);
  fine_views_.write(compute_->queue(), appended_fine_, count(on_device, FINE_VIEW_BYTES));
  coarse_views_.write(compute_->queue(), appended_coarse_, count(on_device, COARSE_VIEW_BYTES));
  appended_fine_.clear();
  appended_coarse_.clear();
}

void ThumbnailMatcher::clear() {
  size_ = 0;
  appended_fine_.clear();
  appended_coarse_.clear();
}

void ThumbnailMatcher::prepareQueries(const std::vector<Thumbnail>& queries) {
  const int n = static_cast<int>(queries.size());
  if (n > query_capacity_) {
    query_capacity_ = std::max(n, 8);
    const cl::Context& context = compute_->context();
    const int copies = query_capacity_ * THUMBNAIL_VARIANTS;
    queries_ = Buffer<cl_char>(context, count(query_capacity_, FINE_VIEW_BYTES));
    fine_queries_ = Buffer<cl_char>(context, count(copies, FINE_QUERY_BYTES));
    coarse_queries_ = Buffer<cl_char>(context, count(copies, COARSE_QUERY_BYTES));
    fine_queries_.fill(compute_->queue(), 0);  // the borders stay 0
    coarse_queries_.fill(compute_->queue(), 0);
  }
  std::vector<cl_char> bytes;
  bytes.reserve(count(n, FINE_VIEW_BYTES));
  for (const Thumbnail& query : queries) bytes.insert(bytes.end(), query.fine.begin(), query.fine.end());
  queries_.write(compute_->queue(), bytes);
  warp_queries_.launch(range(FINE_SIDE, 3 * FINE_SIDE, n * THUMBNAIL_VARIANTS), kWarpGroup, queries_,
                       fine_queries_, n);
  shrink_queries_.launch(range(COARSE_SIDE, 3 * COARSE_SIDE, n * THUMBNAIL_VARIANTS), kShrinkGroup,
                         fine_queries_, coarse_queries_, n);
}

std::vector<float> ThumbnailMatcher::distances(const std::vector<Thumbnail>& queries,
                                               const std::vector<Pair>& pairs) {
  if (pairs.empty()) return {};
  writeAppended();
  prepareQueries(queries);
  std::vector<cl_int2> places;
  places.reserve(pairs.size());
  for (const Pair& pair : pairs) {
    SCANTROVE_CHECK(pair.query >= 0 && pair.query < static_cast<int>(queries.size()));
    SCANTROVE_CHECK(pair.view >= 0 && pair.view < size_);
    places.push_back({{pair.query, pair.view}});
  }
  if (places.size() > pairs_.size()) {
    const std::size_t capacity = std::max<std::size_t>(2 * places.size(), 64);
    pairs_ = Buffer<cl_int2>(compute_->context(), capacity);
    scores_ = Buffer<cl_float>(compute_->context(), capacity * THUMBNAIL_WARPS);
    distances_ = Buffer<cl_float>(compute_->context(), capacity);
  }
  pairs_.write(compute_->queue(), places);
  const int n = static_cast<int>(places.size());
  score_warps_.launch({static_cast<std::size_t>(THUMBNAIL_WARPS), places.size()}, kScoreGroup,
                      coarse_queries_, coarse_views_, pairs_, scores_, n);
  refine_matches_.launch({places.size()}, kRefineGroup, fine_queries_, fine_views_, pairs_, scores_,
                         distances_, n);
  std::vector<float> result(places.size());
  distances_.read(compute_->queue(), result);
  return result;
}

}  // namespace scantrove
