#pragma once
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/catalogue/catalogue_mirror.h"
#include "core/collection/identity_resolver.h"
#include "core/collection/object_tracks.h"
#include "core/collection/observed_frame.h"
#include "core/collection/user_requests.h"
#include "core/collection/view_choice.h"
#include "core/collection/view_keeper.h"

namespace scantrove {

/// Gives each object its best views of all key frames, at the end of the refinement. First every key frame
/// offers its views. chooseViews() decides among them and the views that are stored already. Then the chosen
/// frames are read again, and their views replace the others. Views of objects that a user edited stay; their
/// objects only get further ones.
class BestViews {
 public:
  /// All outlive this.
  BestViews(const CatalogueMirror& catalogue, const ObjectTracks& tracks, const UserRequests& requests,
            const IdentityResolver& identities, ViewKeeper& views)
      : catalogue_(catalogue), tracks_(tracks), requests_(requests), identities_(identities), views_(views) {}

  /// Forgets earlier offers.
  void begin();
  /// The regions of the objects: complete sets, and the regions of objects that a user requested or edited.
  [[nodiscard]] std::vector<RegionSet> sets() const;
  /// A key frame shows the candidate, with its outline. Ignored unless its regions are one object, completely
  /// in a colour image.
  void offer(const Candidate& candidate, const ObservedFrame& observed);
  /// Chooses at most DetectionParams::max_views views for each object. Returns the frames (RgbdFrame::index)
  /// of which views must be stored, ascending.
  [[nodiscard]] std::vector<int> choose();
  /// Stores the view if it was chosen.
  void store(const Candidate& candidate, const ObservedFrame& observed);
  /// The views that were not chosen are outdated, if all chosen ones of their object were stored.
  void finish();

 private:
  using Key = std::pair<RegionSet, int>;  // regions, and the frame that shows them
  struct Offer {
    Key key;
    OfferedView view;
  };
  struct Choice {
    std::set<Key> missing;              // chosen, but not stored yet
    std::vector<std::size_t> replaced;  // stored, but not chosen; indices of ViewKeeper::all()
  };
  [[nodiscard]] Choice choiceFor(ObjectId root, const std::vector<Offer>& offers) const;

  const CatalogueMirror& catalogue_;
  const ObjectTracks& tracks_;
  const UserRequests& requests_;
  const IdentityResolver& identities_;
  ViewKeeper& views_;
  std::map<ObjectId, std::vector<Offer>> offers_;  // by merge root
  std::map<ObjectId, Choice> choices_;             // likewise
};

}  // namespace scantrove
