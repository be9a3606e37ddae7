#include "app/session_review.h"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "app/command.h"
#include "app/json_output.h"
#include "core/editing/frame_review_states.h"
#include "core/session/session_scan.h"

namespace scantrove {
namespace {

/// The current reviews of all key frames with a pose, in order of time.
Result<std::vector<FrameReview>> reviewsOf(OpenSession& session) {
  SessionScan scan(session);
  const auto frames = scan.keyFrames(true);
  if (!frames) return fail(frames.error());
  std::vector<FrameReview> reviews;
  for (const KeyFrameInfo& frame : *frames)
    reviews.push_back({scan.keyFrameOf(frame.index)->frame, frame.index, frame.review});
  return reviews;
}

Json toJson(const std::vector<FrameReview>& reviews) {
  Json frames = Json::array();
  ReviewCounts counts;
  for (const FrameReview& review : reviews) {
    frames.push_back({{"frame", review.image}, {"state", toString(review.state)}});
    counts.add(review.state);
  }
  return {{"frames", std::move(frames)},
          {"open", counts.open},
          {"checked", counts.checked},
          {"left_out", counts.left_out}};
}

Result<void> listReviews(const std::vector<FrameReview>& reviews, bool as_json) {
  if (as_json) {
    printJson(toJson(reviews));
    return {};
  }
  ReviewCounts counts;
  for (const FrameReview& review : reviews) {
    std::cout << std::right << std::setw(6) << review.image << "  " << toString(review.state) << '\n';
    counts.add(review.state);
  }
  std::cout << counts.open << " open, " << counts.checked << " checked, " << counts.left_out << " left out\n";
  return {};
}

}  // namespace

Result<void> reviewKeyFrames(OpenSession& session, const SessionArguments& arguments) {
  const auto reviews = reviewsOf(session);
  if (!reviews) return fail(reviews.error());
  if (arguments.list) return listReviews(*reviews, arguments.json);
  std::vector<FrameReview> wanted;
  for (const int number : arguments.review_frames) {
    const auto found = std::ranges::find(*reviews, number, &FrameReview::image);
    if (found == reviews->end()) {
      return fail("No image of frame " + std::to_string(number) + " was kept in " +
                      session.folder().string() + "; nothing was changed.",
                  "'scantrove session review --list' lists the key frames.");
    }
    // A number given twice is one step of undo.
    if (std::ranges::find(wanted, number, &FrameReview::image) == wanted.end()) wanted.push_back(*found);
  }
  std::vector<FrameReview> changed;
  for (FrameReview& review : wanted) {
    const ReviewState state = reviewStateOf(arguments.review_state).value_or(ReviewState::open);
    if (review.state == state) continue;
    review.state = state;
    Operation operation{.kind = OperationKind::review};
    operation.review = review;
    if (const auto outcome = session.edit(operation); !outcome) return fail(outcome.error());
    changed.push_back(review);
  }
  if (arguments.json) {
    printJson(toJson(changed));
  } else {
    for (const FrameReview& review : changed)
      std::cout << review.image << "  " << toString(review.state) << '\n';
  }
  return {};
}

}  // namespace scantrove
