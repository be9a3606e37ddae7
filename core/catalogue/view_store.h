#pragma once
#include <cstdint>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/object_record.h"

namespace scantrove {

class DatabaseConnection;

/// The views of a catalogue (tables `views`, `view_summaries`, `descriptors`, `view_vectors`, `pictures`).
/// Unusable rows are skipped and named in the log.
class ViewStore {
 public:
  explicit ViewStore(DatabaseConnection& connection) : connection_(connection) {}

  /// With their images, oldest first.
  [[nodiscard]] Result<std::vector<ObjectView>> of(ObjectId id);
  /// A small picture of the object's best view for lists, CV_8UC3 BGR (see listPicture). Empty: the view
  /// has no colour.
  [[nodiscard]] Result<cv::Mat> picture(ObjectId id);
  /// Such pictures of all its views, newest first.
  [[nodiscard]] Result<std::vector<cv::Mat>> pictures(ObjectId id);
  /// Visits the descriptors of all views with id > `after`, including hidden objects, by ascending id, one
  /// at a time; returns the last id. Views of an older version are described first, once (about 1 ms per
  /// view).
  [[nodiscard]] Result<std::int64_t> forEachDescriptor(
      std::int64_t after, const std::function<void(const StoredDescriptor&)>& visit);
  /// Number of views, including those of hidden objects.
  [[nodiscard]] Result<int> count();

  /// Stores a view for `view.object`; its merge root owns it. Inside the caller's transaction. Error: no
  /// such object; images that do not match each other.
  [[nodiscard]] Result<std::int64_t> insert(ObjectView view);

 private:
  DatabaseConnection& connection_;
};

}  // namespace scantrove
