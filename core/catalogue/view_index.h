#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/ids.h"
#include "core/catalogue/object_record.h"
#include "core/catalogue/thumbnail.h"

namespace scantrove {

/// What is known of every view on the host, and the pruning (thesis 5.2): of thousands of views the few that
/// can be a query's, by size, mean colour and the 19 principal components of the 16 x 16 thumbnails of the
/// views themselves. Views are known by their place, 0 .. size() - 1, as in ThumbnailMatcher. One thread.
class ViewIndex {
 public:
  struct Query {
    const Thumbnail& thumbnail;
    Eigen::Vector3f size_m;
  };
  struct Limits {
    float size_tolerance;  ///< as DetectionParams
    float max_distance;    ///< a colour difference that alone exceeds it prunes
    int shortlist;
  };
  /// Below so many views nothing is pruned by components: comparing all is cheaper than fitting them.
  static constexpr int kFewViews = 64;

  [[nodiscard]] int size() const { return static_cast<int>(views_.size()); }
  /// `first_object`: the object that the view was stored for.
  void append(ObjectId first_object, const Thumbnail& thumbnail, const Eigen::Vector3f& size_m);

  /// Views of an object that nobody holds are never worth a comparison.
  void setMergeRoot(const MergeRoot& entry);
  /// None for an object that was deleted or never heard of.
  [[nodiscard]] ObjectId mergeRootOf(ObjectId object) const;
  [[nodiscard]] ObjectId mergeRootAt(int place) const {
    return merge_roots_[views_[static_cast<std::size_t>(place)].owner];
  }

  /// Places worth a comparison, nearest first; at most `shortlist` once there are kFewViews views.
  [[nodiscard]] std::vector<int> shortlist(const Query& query, const Limits& limits);

  /// Places of views that are held by one of the `roots`, whose colour could be the query's, and that are
  /// about as large or up to twice as large.
  [[nodiscard]] std::vector<int> viewsOf(std::span<const ObjectId> roots, const Query& query,
                                         const Limits& limits) const;

  /// What the difference of mean colours adds to the warped distance of a pair.
  [[nodiscard]] float colorTerm(const Thumbnail& query, int place) const;

 private:
  using Coarse = decltype(Thumbnail::coarse);
  using Coordinates = cv::Vec<float, 19>;  ///< along the principal components
  struct View {                            // what every query reads: small
    std::uint32_t owner;                   // of merge_roots_
    Eigen::Vector3f mean_lab;
    float diagonal_m;
    Coordinates coordinates;
  };
  [[nodiscard]] std::uint32_t ownerOf(ObjectId first_object);
  void updateComponents();
  [[nodiscard]] Coordinates project(const Coarse& coarse) const;

  std::vector<View> views_;
  std::unordered_map<ObjectId, std::uint32_t> owners_;  // by first object
  std::vector<ObjectId> merge_roots_;                   // by owner
  // 16 x 16 pixels of the last views: all, as long as components may be fitted to them anew; later those
  // whose coordinates are still to be computed.
  std::vector<Coarse> coarse_;
  cv::PCA components_;  // eigenvectors: none as long as there are few views
  int views_at_fit_ = 0;
  std::size_t projected_ = 0;  // views with coordinates
};

}  // namespace scantrove
