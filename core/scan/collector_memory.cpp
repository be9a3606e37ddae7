#include "core/scan/collector_memory.h"

#include <Eigen/Geometry>
#include <map>
#include <opencv2/core/mat.hpp>
#include <set>
#include <string>
#include <type_traits>
#include <utility>

#include "core/base/byte_stream.h"
#include "core/scan/object_collector.h"

namespace scantrove {
namespace {

constexpr std::uint32_t kMemoryVersion = 1;
constexpr int kLargestImageSide = 1 << 16;  // of an image

template <class T>
concept PlainValue = std::is_arithmetic_v<T> || std::is_same_v<T, ObjectId> || std::is_same_v<T, RegionId>;

template <PlainValue T>
void write(ByteWriter& to, const T& value) {
  to.put(value);
}
void write(ByteWriter& to, bool flag) { to.put(static_cast<std::uint32_t>(flag)); }
void write(ByteWriter& to, const std::string& text) { to.putList(std::span<const char>(text)); }
void write(ByteWriter& to, const Eigen::Vector3f& v) { to.putAll(std::span<const float>(v.data(), 3)); }
void write(ByteWriter& to, const Eigen::Isometry3d& T) { to.putAll(std::span<const double>(T.data(), 16)); }
void write(ByteWriter& to, const RegionSet& regions) {
  to.putList(std::span<const RegionId>(std::vector<RegionId>(regions.begin(), regions.end())));
}
void write(ByteWriter& to, const cv::Mat& image) {
  to.put(image.rows);
  to.put(image.cols);
  to.put(image.type());
  const std::size_t row_bytes = static_cast<std::size_t>(image.cols) * image.elemSize();
  for (int row = 0; row < image.rows; ++row)
    to.putAll(std::span<const unsigned char>(image.ptr(row), row_bytes));
}
void write(ByteWriter& to, const KeptView& view) {
  write(to, view.object);
  write(to, view.frame_index);
  write(to, view.T_world_camera);
  for (const int number : {view.image_px.width, view.image_px.height, view.box_px.x, view.box_px.y})
    to.put(number);
  write(to, view.mask);
  write(to, view.z_m);
  write(to, view.direction);
  write(to, view.diagonal_m);
  write(to, view.is_outdated);
  write(to, view.shows_removed_object);
}

template <class A, class B>
void write(ByteWriter& to, const std::pair<A, B>& pair);
template <class Container>
requires requires(const Container& all) {
  typename Container::value_type;
  all.size();
  all.begin();
}
void writeEach(ByteWriter& to, const Container& all);
template <class K, class V>
void write(ByteWriter& to, const std::map<K, V>& map) {
  writeEach(to, map);
}
template <class A, class B>
void write(ByteWriter& to, const std::pair<A, B>& pair) {
  write(to, pair.first);
  write(to, pair.second);
}
template <class Container>
requires requires(const Container& all) {
  typename Container::value_type;
  all.size();
  all.begin();
}
void writeEach(ByteWriter& to, const Container& all) {
  to.put(static_cast<std::uint64_t>(all.size()));
  for (const auto& one : all) write(to, one);
}

template <class T>
struct Read;
template <class T>
T read(ByteReader& from) {
  return Read<T>{}(from);
}
template <PlainValue T>
requires(!std::is_same_v<T, bool>) struct Read<T> {
  T operator()(ByteReader& from) const { return from.get<T>(); }
};
template <>
struct Read<bool> {
  bool operator()(ByteReader& from) const { return from.get<std::uint32_t>() != 0; }
};
template <>
struct Read<std::string> {
  std::string operator()(ByteReader& from) const {
    const std::vector<char> letters = from.getList<char>();
    return {letters.begin(), letters.end()};
  }
};
template <>
struct Read<Eigen::Vector3f> {
  Eigen::Vector3f operator()(ByteReader& from) const {
    Eigen::Vector3f v = Eigen::Vector3f::Zero();
    from.getAll(std::span<float>(v.data(), 3));
    if (!v.allFinite()) from.refuse();
    return v;
  }
};
template <>
struct Read<Eigen::Isometry3d> {
  Eigen::Isometry3d operator()(ByteReader& from) const {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    from.getAll(std::span<double>(T.data(), 16));
    if (!T.matrix().allFinite()) from.refuse();
    return T;
  }
};
template <>
struct Read<RegionSet> {
  RegionSet operator()(ByteReader& from) const {
    RegionSet regions;
    for (const RegionId region : from.getList<RegionId>()) regions.add(region);
    return regions;
  }
};
template <class A, class B>
struct Read<std::pair<A, B>> {
  std::pair<A, B> operator()(ByteReader& from) const {
    A first = read<A>(from);
    return {std::move(first), read<B>(from)};
  }
};
template <class T>
std::vector<T> readEach(ByteReader& from) {
  const auto count = from.get<std::uint64_t>();
  std::vector<T> all;
  for (std::uint64_t i = 0; i < count && from.ok(); ++i) all.push_back(read<T>(from));
  return all;
}
template <class K, class V>
struct Read<std::map<K, V>> {
  std::map<K, V> operator()(ByteReader& from) const {
    std::map<K, V> map;
    for (auto& [key, value] : readEach<std::pair<K, V>>(from)) map.emplace(key, std::move(value));
    return map;
  }
};
template <class T>
struct Read<std::set<T>> {
  std::set<T> operator()(ByteReader& from) const {
    const std::vector<T> all = readEach<T>(from);
    return {all.begin(), all.end()};
  }
};

cv::Mat readImage(ByteReader& from, int type, const cv::Size& most) {
  const int rows = from.get<int>(), cols = from.get<int>(), stored_type = from.get<int>();
  const bool is_image = rows > 0 && cols > 0 && rows <= most.height && cols <= most.width &&
                        stored_type == type &&
                        static_cast<std::size_t>(rows) <= from.bytesLeft() / static_cast<std::size_t>(cols);
  if (!is_image) {
    from.refuse();
    return {};
  }
  cv::Mat image(rows, cols, type);
  const std::size_t row_bytes = static_cast<std::size_t>(cols) * image.elemSize();
  for (int row = 0; row < rows; ++row) from.getAll(std::span<unsigned char>(image.ptr(row), row_bytes));
  return image;
}

template <>
struct Read<KeptView> {
  KeptView operator()(ByteReader& from) const {
    KeptView view;
    view.object = read<ObjectId>(from);
    view.frame_index = read<int>(from);
    view.T_world_camera = read<Eigen::Isometry3d>(from);
    view.image_px.width = from.get<int>();
    view.image_px.height = from.get<int>();
    view.box_px.x = from.get<int>();
    view.box_px.y = from.get<int>();
    const auto isSide = [](int side) { return side > 0 && side < kLargestImageSide; };
    if (!isSide(view.image_px.width) || !isSide(view.image_px.height)) from.refuse();
    view.mask = readImage(from, CV_8UC1, view.image_px);
    view.z_m = readImage(from, CV_32FC1, view.image_px);
    view.box_px = {view.box_px.tl(), view.mask.size()};
    const cv::Rect image({}, view.image_px);
    if (view.z_m.size() != view.mask.size() || (view.box_px & image) != view.box_px) from.refuse();
    view.direction = read<Eigen::Vector3f>(from);
    view.diagonal_m = read<float>(from);
    view.is_outdated = read<bool>(from);
    view.shows_removed_object = read<bool>(from);
    return view;
  }
};

void write(ByteWriter& to, const MetObjects::Met& met) {
  write(to, met.centroid_world);
  write(to, met.size_m);
  write(to, met.last_frame);
  write(to, met.times_empty);
  writeEach(to, met.views.directions());
}

template <>
struct Read<MetObjects::Met> {
  MetObjects::Met operator()(ByteReader& from) const {
    MetObjects::Met met;
    met.centroid_world = read<Eigen::Vector3f>(from);
    met.size_m = read<Eigen::Vector3f>(from);
    met.last_frame = read<int>(from);
    met.times_empty = read<int>(from);
    met.views = ViewSphere(readEach<Eigen::Vector3f>(from));
    return met;
  }
};

}  // namespace

std::vector<std::uint32_t> CollectorMemory::of(const ObjectCollector& collector) {
  ByteWriter to;
  to.put(kMemoryVersion);
  const CatalogueMirror& mirror = collector.catalogue_;
  to.put(collector.writer_->session());
  to.put(collector.writer_->lastEvent());
  to.put(mirror.next_key_);
  writeEach(to, mirror.idsOfThisScan());
  writeEach(to, mirror.kept_apart_);
  writeEach(to, mirror.regrouped_);

  const MetObjects& met = collector.met_;
  to.put(static_cast<std::uint64_t>(met.met_.size()));
  for (const auto& [object, one] : met.met_) {
    write(to, object);
    write(to, one);
  }
  writeEach(to, std::map<RegionId, ObjectId>(met.object_of_region_.begin(), met.object_of_region_.end()));
  to.put(static_cast<std::uint64_t>(collector.recognition_.tallies_.size()));
  for (const auto& [regions, tally] : collector.recognition_.tallies_) {
    write(to, regions);
    write(to, tally.observations);
    write(to, tally.last_frame);
    to.put(static_cast<std::uint64_t>(tally.votes.size()));
    for (const auto& [object, votes] : tally.votes) {
      write(to, object);
      write(to, votes.observations);
      write(to, votes.sure);
    }
  }
  writeEach(to, collector.wanted_);
  writeEach(to, collector.not_these_);
  to.put(static_cast<std::uint64_t>(collector.doubts_.size()));
  for (const auto& [regions, doubt] : collector.doubts_) {
    write(to, regions);
    write(to, doubt.object);
    write(to, doubt.observations);
    write(to, doubt.last_frame);
  }
  writeEach(to, collector.successor_);
  writeEach(to, collector.side_by_side_);
  writeEach(to, collector.kept_views_);
  for (const auto* objects : {&collector.by_person_, &collector.back_, &collector.moved_})
    writeEach(to, *objects);
  writeEach(to, collector.appeared_);
  writeEach(to, collector.wholes_);
  writeEach(to, collector.looks_back_);
  write(to, collector.is_looking_again_);
  write(to, collector.are_last_looks_);
  write(to, collector.frame_);
  return to.take();
}

std::optional<CollectorMemory::Catalogue> CollectorMemory::restore(std::span<const std::uint32_t> words,
                                                                   ObjectCollector& collector) {
  ByteReader from(words);
  if (from.get<std::uint32_t>() != kMemoryVersion) return std::nullopt;
  Catalogue catalogue;
  catalogue.session = from.get<std::int64_t>();
  catalogue.event = from.get<std::int64_t>();
  const auto next_key = from.get<std::uint32_t>();
  const auto ids = read<std::map<ObjectId, ObjectId>>(from);
  auto kept_apart = read<std::set<std::pair<ObjectId, ObjectId>>>(from);
  auto regrouped = read<std::set<ObjectId>>(from);
  auto met = read<std::map<ObjectId, MetObjects::Met>>(from);
  const auto object_of_region = read<std::map<RegionId, ObjectId>>(from);
  decltype(RecognitionHistory::tallies_) tallies;
  const auto tally_count = from.get<std::uint64_t>();
  for (std::uint64_t i = 0; i < tally_count && from.ok(); ++i) {
    auto& tally = tallies[read<RegionSet>(from)];
    tally.observations = read<int>(from);
    tally.last_frame = read<int>(from);
    const auto vote_count = from.get<std::uint64_t>();
    for (std::uint64_t j = 0; j < vote_count && from.ok(); ++j) {
      auto& votes = tally.votes[read<ObjectId>(from)];
      votes.observations = read<int>(from);
      votes.sure = read<bool>(from);
    }
  }
  auto requested = read<std::map<RegionId, std::string>>(from);
  auto not_these = read<std::map<RegionId, ObjectId>>(from);
  decltype(ObjectCollector::doubts_) doubts;
  const auto doubt_count = from.get<std::uint64_t>();
  for (std::uint64_t i = 0; i < doubt_count && from.ok(); ++i) {
    auto& doubt = doubts[read<RegionSet>(from)];
    doubt.object = read<ObjectId>(from);
    doubt.observations = read<int>(from);
    doubt.last_frame = read<int>(from);
  }
  auto successor = read<std::map<ObjectId, ObjectId>>(from);
  auto side_by_side = read<std::set<std::pair<ObjectId, ObjectId>>>(from);
  auto kept_views = readEach<KeptView>(from);
  auto by_person = read<std::set<ObjectId>>(from);
  auto back = read<std::set<ObjectId>>(from);
  auto moved = read<std::set<ObjectId>>(from);
  auto appeared = read<std::map<ObjectId, std::map<ObjectId, int>>>(from);
  auto wholes = read<std::map<RegionSet, int>>(from);
  auto looks_back = read<std::map<ObjectId, int>>(from);
  const bool is_looking_again = read<bool>(from);
  const bool are_last_looks = read<bool>(from);
  const int frame = read<int>(from);
  if (!from.isAtEnd()) return std::nullopt;

  CatalogueMirror& mirror = collector.catalogue_;
  mirror.continueSession(catalogue.session, next_key, ids);
  mirror.kept_apart_ = std::move(kept_apart);
  mirror.regrouped_ = std::move(regrouped);
  collector.met_.met_ = std::move(met);
  collector.met_.object_of_region_ = {object_of_region.begin(), object_of_region.end()};
  collector.recognition_.tallies_ = std::move(tallies);
  collector.wanted_ = std::move(requested);
  collector.not_these_ = std::move(not_these);
  collector.doubts_ = std::move(doubts);
  collector.successor_ = std::move(successor);
  collector.side_by_side_ = std::move(side_by_side);
  collector.kept_views_ = std::move(kept_views);
  collector.by_person_ = std::move(by_person);
  collector.back_ = std::move(back);
  collector.moved_ = std::move(moved);
  collector.appeared_ = std::move(appeared);
  collector.wholes_ = std::move(wholes);
  collector.looks_back_ = std::move(looks_back);
  collector.is_looking_again_ = is_looking_again;
  collector.are_last_looks_ = are_last_looks;
  collector.frame_ = frame;
  return catalogue;
}

Result<void> CollectorMemory::checkObjects(const ObjectCollector& collector) {
  const CatalogueMirror& mirror = collector.catalogue_;
  for (const auto& [key, id] : mirror.ids_) {
    if (!mirror.objects_.contains(key))
      return fail(
          "The catalogue does not have object " + std::to_string(id.value) + ", which this scan added to it.",
          "Put back the catalogue that the scan was made with.");
  }
  return {};
}

}  // namespace scantrove
