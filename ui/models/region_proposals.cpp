#include "ui/models/region_proposals.h"

#include <QByteArray>
#include <QSettings>
#include <algorithm>
#include <cmath>
#include <cstring>

namespace scantrove {
namespace {

constexpr float kMinLikeness = 0.45F;
constexpr std::size_t kMaxProposals = 12;
constexpr std::size_t kMaxRejections = 200;
constexpr float kSameAppearance = 0.75F;
constexpr float kMinDifference = 0.03F;
const QString kRejectionsKey = QStringLiteral("proposals/rejected");

QByteArray bytesOf(const RegionAppearance& appearance) {
  QByteArray bytes(reinterpret_cast<const char*>(appearance.size_m.data()), 3 * sizeof(float));
  const ColorHistogram::Shares colors = appearance.colors.shares();
  bytes.append(reinterpret_cast<const char*>(colors.data()), sizeof(colors));
  return bytes;
}

std::optional<RegionAppearance> appearanceOf(const QByteArray& bytes) {
  RegionAppearance appearance;
  ColorHistogram::Shares colors{};
  constexpr std::size_t kOfSize = 3 * sizeof(float);
  if (static_cast<std::size_t>(bytes.size()) != kOfSize + sizeof(colors)) return std::nullopt;
  std::memcpy(appearance.size_m.data(), bytes.constData(), kOfSize);
  std::memcpy(colors.data(), bytes.constData() + kOfSize, sizeof(colors));
  appearance.colors = ColorHistogram::ofShares(colors);
  return appearance;
}

}  // namespace

RegionProposals::RegionProposals(QObject* parent) : QObject(parent) { load(); }

void RegionProposals::propose(RegionId named, const QString& name, const QString& category,
                              const Appearances& appearances) {
  const auto model = appearances.find(named);
  open_.clear();
  observations_.clear();
  if (model != appearances.end() && !name.isEmpty()) {
    for (const auto& [region, appearance] : appearances) {
      const float likeness_to_region = likeness(model->second, appearance);
      if (region == named || likeness_to_region < kMinLikeness ||
          isRejected(name, region, appearance, likeness_to_region))
        continue;
      open_.push_back({region, name, category, likeness_to_region, appearance.size_m});
      observations_[region] = appearance;
    }
  }
  std::ranges::stable_sort(open_, std::ranges::greater{}, &Proposal::likeness);
  if (open_.size() > kMaxProposals) open_.resize(kMaxProposals);
  emit changed();
}

bool RegionProposals::isRejected(const QString& name, RegionId region, const RegionAppearance& appearance,
                                 float likeness_to_named) const {
  if (rejected_.contains({region, name})) return true;
  return std::ranges::any_of(rejections_, [&](const Rejection& rejection) {
    if (rejection.name != name) return false;
    const float to_rejected = likeness(rejection.appearance, appearance);
    return to_rejected > kSameAppearance && to_rejected > likeness_to_named + kMinDifference;
  });
}

void RegionProposals::withdraw() {
  open_.clear();
  observations_.clear();
  emit changed();
}

void RegionProposals::clear() {
  rejected_.clear();
  withdraw();
}

std::vector<Proposal> RegionProposals::acceptFirst() {
  if (open_.empty()) return {};
  const Proposal first = open_.front();
  open_.erase(open_.begin());
  emit changed();
  return {first};
}

std::vector<Proposal> RegionProposals::acceptAll() {
  std::vector<Proposal> all = std::exchange(open_, {});
  emit changed();
  return all;
}

void RegionProposals::rejectFirst() {
  if (open_.empty()) return;
  const Proposal first = open_.front();
  rejected_.insert({first.region, first.name});
  rejections_.push_back({first.name, observations_[first.region]});
  if (rejections_.size() > kMaxRejections) rejections_.erase(rejections_.begin());
  save();
  open_.erase(open_.begin());
  emit changed();
}

void RegionProposals::drop(RegionId region) {
  if (std::erase_if(open_, [&](const Proposal& proposal) { return proposal.region == region; }) > 0)
    emit changed();
}

void RegionProposals::load() {
  for (const QVariant& entry : QSettings().value(kRejectionsKey).toList()) {
    const QVariantList pair = entry.toList();
    if (pair.size() != 2) continue;
    if (const auto appearance = appearanceOf(pair[1].toByteArray()))
      rejections_.push_back({pair[0].toString(), *appearance});
  }
}

void RegionProposals::save() const {
  QVariantList list;
  for (const Rejection& rejection : rejections_)
    list.push_back(QVariantList{rejection.name, bytesOf(rejection.appearance)});
  QSettings().setValue(kRejectionsKey, list);
}

QString reasonOf(const Proposal& proposal) {
  const auto cm = [&](int axis) { return QString::number(std::lround(100 * proposal.size_m[axis])); };
  return RegionProposals::tr("%1 %, %2 × %3 × %4 cm")
      .arg(std::lround(100 * proposal.likeness))
      .arg(cm(0), cm(1), cm(2));
}

}  // namespace scantrove
