#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/catalog/principal_components.h"
#include "core/catalog/thumbnail.h"

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
  [[nodiscard]] ObjectId objectAt(int place) const { return views_[static_cast<std::size_t>(place)].object; }
  /// The place of any view of the object; the last one.
  [[nodiscard]] std::optional<int> find(ObjectId object) const;

  void append(ObjectId object, const Thumbnail& thumbnail, const Eigen::Vector3f& size_m);
  void removeByLast(int place);
  void clear();

  /// Places worth a comparison, nearest first; at most `shortlist` once there are kFewViews views.
  [[nodiscard]] std::vector<int> shortlist(const Query& query, const Limits& limits) const;

  /// What the difference of mean colours adds to the warped distance of a pair.
  [[nodiscard]] float colorTerm(const Thumbnail& query, int place) const;

 private:
  using Coarse = decltype(Thumbnail::coarse);
  struct View {  // what every query reads: small
    ObjectId object;
    Eigen::Vector3f mean_lab;
    float diagonal_m;
    PrincipalComponents::Coordinates coordinates;
  };
  void fitComponents();

  std::vector<View> views_;
  std::vector<Coarse> coarse_;  // to fit the components to
  PrincipalComponents components_;
  int views_at_fit_ = 0;
};

}  // namespace scantrove
