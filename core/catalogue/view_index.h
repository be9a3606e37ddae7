#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/ids.h"
#include "core/catalogue/match_distance.h"
#include "core/catalogue/object_record.h"
#include "core/catalogue/view_descriptor.h"
#include "core/catalogue/view_sketches.h"

namespace scantrove {

/// Host data of all views, and pruning (thesis 5.2): selects the few views worth a comparison by size, mean
/// colour and 19 principal components of the views' 16 x 16 thumbnails. From kManyViews on, sketches of the
/// views select kNearBySketch of them, whose histograms of colours are then compared: among 100,000 views the
/// components and mean colours miss the right object of every thirtieth query. Views are identified by index,
/// 0 .. size() - 1, as in ThumbnailMatcher. One thread.
class ViewIndex {
 public:
  struct Query {
    const ViewDescriptor& descriptor;
    Eigen::Vector3f size_m;
  };
  /// Of views that viewsOf() returns.
  struct Limits {
    float size_tolerance;  ///< as DetectionParams
    float max_distance;    ///< maximum difference of mean colours
  };
  /// With fewer views components prune nothing: comparing all is faster than fitting them.
  static constexpr int kFewViews = 64;
  /// From so many views on their sketches prune.
  static constexpr int kManyViews = 2000;
  static constexpr std::size_t kNearBySketch = 512;
  /// Views that viewsOf() returns at most, if there are sketches.
  static constexpr std::size_t kMostOfRoots = 512;
  /// Views of one object in a shortlist: the others must not crowd out the runners-up.
  static constexpr int kViewsOfAnObject = 3;

  [[nodiscard]] int size() const { return static_cast<int>(views_.size()); }
  /// `first_object`: the object that the view was stored for.
  void append(ObjectId first_object, const ViewDescriptor& descriptor, const Eigen::Vector3f& size_m);

  /// Views without an owner are never compared.
  void setMergeRoot(const MergeRoot& entry);
  /// None for a deleted or unknown object.
  [[nodiscard]] ObjectId mergeRootOf(ObjectId object) const;
  [[nodiscard]] ObjectId mergeRootAt(int place) const {
    return merge_roots_[views_[static_cast<std::size_t>(place)].owner];
  }

  /// Number of objects with views, counted up to `most`.
  [[nodiscard]] int countObjects(int most) const;

  /// Indices of views worth a comparison, probably nearest first. From kFewViews views on at most `most`, and
  /// kViewsOfAnObject of one object.
  [[nodiscard]] std::vector<int> shortlist(const Query& query, int most);

  /// Indices of views owned by one of the `roots` with a similar colour, and from about the same to twice
  /// the size. From kManyViews on at most kMostOfRoots, the most similar in shape and colour.
  [[nodiscard]] std::vector<int> viewsOf(std::span<const ObjectId> roots, const Query& query,
                                         const Limits& limits) const;

  /// Whether the diagonals differ by at most `tolerance` of the larger one, or a size is unknown.
  [[nodiscard]] bool hasSize(const Query& query, int place, float tolerance) const;

  /// All that differs between a query and a view but the shape and the network's vector.
  [[nodiscard]] ViewDifference difference(const Query& query, int place) const;
  [[nodiscard]] const std::optional<NetworkVector>& networkAt(int place) const {
    return networks_[static_cast<std::size_t>(place)];
  }

 private:
  using Coarse = decltype(Thumbnail::coarse);
  using Coordinates = cv::Vec<float, 19>;  ///< along the principal components
  struct View {                            // read by every query, so kept small
    std::uint32_t owner;                   // of merge_roots_
    Eigen::Vector3f mean_lab;
    Eigen::Vector3f size_m;
    float energy;  // sum of squares of the 16 x 16 pixels
  };
  struct Ranked {
    float distance;
    int place;
  };
  [[nodiscard]] std::uint32_t ownerOf(ObjectId first_object);
  void updateComponents();
  /// Sketches take the place of the components.
  void beginSketches();
  [[nodiscard]] Coordinates project(const Coarse& coarse) const;
  /// All views with an owner, with their probable distances, in order of place.
  [[nodiscard]] std::vector<Ranked> rank(const Query& query) const;
  /// The nearest views by their sketches, with their probable distances.
  [[nodiscard]] std::vector<Ranked> rankBySketch(const Query& query) const;
  /// Whether the views of fewer objects than a verdict needs are among them, though the catalogue has more.
  [[nodiscard]] bool areOfTooFew(const std::vector<ViewSketches::Near>& near) const;

  std::vector<View> views_;
  std::vector<std::optional<ViewColors>> colors_;       // by view
  std::vector<std::optional<NetworkVector>> networks_;  // by view
  std::unordered_map<ObjectId, std::uint32_t> owners_;  // by first object
  std::vector<ObjectId> merge_roots_;                   // by owner
  // While there are few views:
  std::vector<Coarse> coarse_;            // by view
  std::vector<Coordinates> coordinates_;  // by view, as many as were projected
  cv::PCA components_;                    // eigenvectors; none while there are very few
  int views_at_fit_ = 0;
  ViewSketches sketches_;  // of all views, once there are many
};

}  // namespace scantrove
