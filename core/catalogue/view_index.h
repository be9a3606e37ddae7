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

/// Host data of all views, and pruning (thesis 5.2): selects the few views that may match a query by size,
/// mean colour and 19 principal components of the views' 16 x 16 thumbnails. Views are identified by index,
/// 0 .. size() - 1, as in ThumbnailMatcher. One thread.
class ViewIndex {
 public:
  struct Query {
    const Thumbnail& thumbnail;
    Eigen::Vector3f size_m;
  };
  struct Limits {
    float size_tolerance;  ///< as DetectionParams
    float max_distance;    ///< a larger colour difference alone prunes
    int shortlist;
  };
  /// With fewer views components prune nothing: comparing all is faster than fitting them.
  static constexpr int kFewViews = 64;

  [[nodiscard]] int size() const { return static_cast<int>(views_.size()); }
  /// `first_object`: the object that the view was stored for.
  void append(ObjectId first_object, const Thumbnail& thumbnail, const Eigen::Vector3f& size_m);

  /// Views without an owner are never compared.
  void setMergeRoot(const MergeRoot& entry);
  /// None for a deleted or unknown object.
  [[nodiscard]] ObjectId mergeRootOf(ObjectId object) const;
  [[nodiscard]] ObjectId mergeRootAt(int place) const {
    return merge_roots_[views_[static_cast<std::size_t>(place)].owner];
  }

  /// Indices of views worth a comparison, nearest first; at most `shortlist` from kFewViews views on.
  [[nodiscard]] std::vector<int> shortlist(const Query& query, const Limits& limits);

  /// Indices of views owned by one of the `roots` with a similar colour, and from about the same to twice
  /// the size.
  [[nodiscard]] std::vector<int> viewsOf(std::span<const ObjectId> roots, const Query& query,
                                         const Limits& limits) const;

  /// The part of a pair's distance that is due to mean colours.
  [[nodiscard]] float colorTerm(const Thumbnail& query, int place) const;

 private:
  using Coarse = decltype(Thumbnail::coarse);
  using Coordinates = cv::Vec<float, 19>;  ///< along the principal components
  struct View {                            // read by every query, so kept small
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
  // 16 x 16 pixels of the newest views: of all while components may be fitted again, later of those without
  // coordinates.
  std::vector<Coarse> coarse_;
  cv::PCA components_;  // eigenvectors; none while there are few views
  int views_at_fit_ = 0;
  std::size_t projected_ = 0;  // views with coordinates
};

}  // namespace scantrove
