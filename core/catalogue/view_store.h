#pragma once
#include <cstdint>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/object_record.h"

namespace scantrove {

class DatabaseConnection;

/// The views of a catalogue (tables `views`, `view_summaries`, `descriptors`, `pictures`). A row that cannot
/// be used is left out and named in the log.
class ViewStore {
 public:
  explicit ViewStore(DatabaseConnection& connection) : connection_(connection) {}

  /// With their images, oldest first.
  [[nodiscard]] Result<std::vector<ObjectView>> of(ObjectId id);
  /// A small picture of the object's best view, CV_8UC3 BGR, for lists (see listPicture). Empty when it has
  /// no colour.
  [[nodiscard]] Result<cv::Mat> picture(ObjectId id);
  /// Such pictures of all its views, newest first.
  [[nodiscard]] Result<std::vector<cv::Mat>> pictures(ObjectId id);
  /// Visits the descriptors of all views with id > `after`, of hidden objects too, by ascending id, one at a
  /// time; returns the last id. Views of an older version are described first, once (about 1 ms a view).
  [[nodiscard]] Result<std::int64_t> forEachDescriptor(
      std::int64_t after, const std::function<void(const StoredDescriptor&)>& visit);
  /// How many views there are, of hidden objects too.
  [[nodiscard]] Result<int> count();

  /// Stores a view for `view.object`; it belongs to what that was merged into. Inside the caller's
  /// transaction. Error: no such object; images that do not belong together.
  [[nodiscard]] Result<std::int64_t> insert(ObjectView view);

 private:
  DatabaseConnection& connection_;
};

}  // namespace scantrove
