#include "core/collection/best_views.h"

#include <algorithm>
#include <optional>

namespace scantrove {

void BestViews::begin() {
  offers_.clear();
  choices_.clear();
}

std::vector<RegionSet> BestViews::sets() const {
  std::vector<RegionSet> sets;
  for (const auto& [regions, best_frame] : identities_.complete()) {
    if (tracks_.objectOf(regions)) sets.push_back(regions);
  }
  const std::size_t complete = sets.size();
  for (const auto& [object, track] : tracks_.all()) {
    if (!requests_.isEdited(object)) continue;
    RegionSet regions;
    for (const RegionId region : tracks_.regionsOf(object)) regions.add(region);
    const bool is_known = std::any_of(sets.begin(), sets.begin() + static_cast<std::ptrdiff_t>(complete),
                                      [&](const RegionSet& set) { return set.overlaps(regions); });
    if (!regions.empty() && !is_known) sets.push_back(regions);
  }
  return sets;
}

void BestViews::offer(const Candidate& candidate, const ObservedFrame& observed) {
  const ObjectId root = catalogue_.mergeRootOf(tracks_.objectOf(candidate.regions));
  if (!root || candidate.is_cut_off || !observed.hasColor()) return;
  offers_[root].push_back({{candidate.regions, observed.frame.index},
                           {observed.directionOf(candidate), ViewKeeper::qualityOf(candidate, observed)}});
}

std::vector<int> BestViews::choose() {
  choices_.clear();
  std::set<int> frames;
  for (const auto& [root, offers] : offers_) {
    Choice choice = choiceFor(root, offers);
    for (const Key& key : choice.missing) frames.insert(key.second);
    choices_[root] = std::move(choice);
  }
  return {frames.begin(), frames.end()};
}

BestViews::Choice BestViews::choiceFor(ObjectId root, const std::vector<Offer>& offers) const {
  const ObjectRecord* record = catalogue_.record(root);
  if (record == nullptr) return {};
  // Stored views first, with the quality that the key frame shows now.
  std::vector<OfferedView> views;
  std::vector<std::size_t> stored;
  std::set<int> stored_frames;
  int of_this_scan = 0;
  bool are_fixed = requests_.isEdited(root) || !catalogue_.model().mayDiscardViews(root);
  for (std::size_t i = 0; i < views_.all().size(); ++i) {
    const StoredView& view = views_.all()[i];
    if (catalogue_.mergeRootOf(view.object) != root) continue;
    ++of_this_scan;
    are_fixed = are_fixed || requests_.isEdited(view.object);
    if (!view.isValid()) continue;
    const auto now =
        std::ranges::find(offers, view.frame_index, [](const Offer& offer) { return offer.key.second; });
    views.push_back({view.direction, now == offers.end() ? view.quality : now->view.quality});
    stored.push_back(i);
    stored_frames.insert(view.frame_index);
  }
  std::vector<const Offer*> others;
  for (const Offer& offer : offers) {
    if (stored_frames.contains(offer.key.second)) continue;
    views.push_back(offer.view);
    others.push_back(&offer);
  }
  const int of_other_scans = record->views - of_this_scan;
  const auto most = static_cast<std::size_t>(std::max(0, views_.params().max_views - of_other_scans));
  const std::vector<std::size_t> chosen = chooseViews(views, are_fixed ? stored.size() : 0, most);
  Choice choice;
  for (const std::size_t i : chosen) {
    if (i >= stored.size()) choice.missing.insert(others[i - stored.size()]->key);
  }
  for (std::size_t i = 0; i < stored.size() && !chosen.empty(); ++i) {
    if (std::ranges::find(chosen, i) == chosen.end()) choice.replaced.push_back(stored[i]);
  }
  return choice;
}

void BestViews::store(const Candidate& candidate, const ObservedFrame& observed) {
  const ObjectId object = tracks_.objectOf(candidate.regions);
  const auto choice = choices_.find(catalogue_.mergeRootOf(object));
  if (choice == choices_.end()) return;
  const auto key = choice->second.missing.find({candidate.regions, observed.frame.index});
  if (key != choice->second.missing.end() && views_.storeView(object, candidate, observed))
    choice->second.missing.erase(key);
}

void BestViews::finish() {
  std::vector<std::size_t> replaced;
  for (const auto& [root, choice] : choices_) {
    if (choice.missing.empty())
      replaced.insert(replaced.end(), choice.replaced.begin(), choice.replaced.end());
  }
  views_.replace(replaced);
  begin();
}

}  // namespace scantrove
