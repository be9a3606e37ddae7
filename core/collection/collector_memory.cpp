#include "core/collection/collector_memory.h"

#include <cmath>
#include <concepts>
#include <map>
#include <opencv2/core.hpp>
#include <set>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>

#include "core/base/byte_stream.h"

namespace scantrove {
namespace {

constexpr std::uint32_t kMemoryVersion = 4;
constexpr std::uint32_t kWithQuality = 2;     ///< first version with StoredView::quality
constexpr std::uint32_t kWithIntrinsics = 3;  ///< first version with StoredView::intrinsics
constexpr std::uint32_t kWithClasses = 4;     ///< first version with GivenName::class_name
constexpr int kLargestImageSide = 1 << 16;    // of an image

// Each record is described once, in describe(): writing and reading visit its fields in that order.

template <class T, class Record>
concept SameRecord = std::same_as<std::remove_const_t<T>, Record>;

template <class Archive, SameRecord<GivenName> T>
void describe(Archive& archive, T& given) {
  archive(given.name);
  if (archive.version() >= kWithClasses) archive(given.class_name);
}
template <class Archive, SameRecord<ObjectTrack> T>
void describe(Archive& archive, T& track) {
  archive(track.centroid_world, track.size_m, track.last_frame, track.frames_empty, track.views);
}
template <class Archive, SameRecord<RecognitionHistory::Votes> T>
void describe(Archive& archive, T& votes) {
  archive(votes.attempts, votes.sure);
}
template <class Archive, SameRecord<RecognitionHistory::Tally> T>
void describe(Archive& archive, T& tally) {
  archive(tally.attempts, tally.last_frame, tally.votes);
}
template <class Archive, SameRecord<IdentityResolver::Mismatch> T>
void describe(Archive& archive, T& mismatch) {
  archive(mismatch.object, mismatch.count, mismatch.last_frame);
}
template <class Archive, SameRecord<StoredView> T>
void describe(Archive& archive, T& view) {
  archive(view.object, view.frame_index, view.T_world_camera, view.image_px.width, view.image_px.height,
          view.box_px.x, view.box_px.y, view.mask, view.z_m, view.direction, view.diagonal_m,
          view.is_outdated, view.is_of_removed);
  if (archive.version() >= kWithQuality) {
    archive(view.quality.pixels, view.quality.sharpness, view.quality.outline, view.quality.hidden);
  }
  if (archive.version() >= kWithIntrinsics) archive(view.intrinsics);
}
template <class Archive, SameRecord<CollectorState> T>
void describe(Archive& archive, T& state) {
  archive(state.catalogue.session, state.last_event, state.catalogue.next_key, state.catalogue.ids,
          state.catalogue.kept_apart, state.catalogue.merge_edited);
  archive(state.tracks.tracks, state.tracks.object_of_region, state.recognizer.history);
  archive(state.requests.pending, state.requests.not_objects);
  archive(state.identities.mismatches, state.identities.replaced_by, state.identities.seen_together);
  archive(state.views, state.requests.requested, state.recognizer.returned, state.tracks.moved,
          state.recognizer.appeared);
  archive(state.identities.complete, state.recognizer.comparisons);
  archive(state.is_refining, state.is_last_pass, state.frame);
}

template <class T>
concept PlainValue = (std::is_arithmetic_v<T> && !std::same_as<T, bool>) || std::same_as<T, ObjectId> ||
                     std::same_as<T, RegionId>;

class MemoryWriter {
 public:
  template <class... Values>
  void operator()(const Values&... values) {
    (write(values), ...);
  }
  [[nodiscard]] static std::uint32_t version() { return kMemoryVersion; }
  [[nodiscard]] std::vector<std::uint32_t> take() { return to_.take(); }

 private:
  template <class Record>
  void write(const Record& record) {
    describe(*this, record);
  }
  template <PlainValue T>
  void write(const T& value) {
    to_.put(value);
  }
  void write(bool flag) { to_.put(static_cast<std::uint32_t>(flag)); }
  void write(const std::string& text) { to_.putList(std::span<const char>(text)); }
  void write(const Eigen::Vector3f& v) { to_.putAll(std::span<const float>(v.data(), 3)); }
  void write(const Eigen::Isometry3d& T) { to_.putAll(std::span<const double>(T.data(), 16)); }
  void write(const RegionSet& regions) {
    to_.putList(std::span<const RegionId>(std::vector<RegionId>(regions.begin(), regions.end())));
  }
  void write(const cv::Mat& image) {
    (*this)(image.rows, image.cols, image.type());
    const std::size_t row_bytes = static_cast<std::size_t>(image.cols) * image.elemSize();
    for (int row = 0; row < image.rows; ++row)
      to_.putAll(std::span<const unsigned char>(image.ptr(row), row_bytes));
  }
  void write(const std::optional<Intrinsics>& K) { to_.put(K.value_or(Intrinsics{})); }
  void write(const ViewSphere& views) { write(views.directions()); }
  void write(const RecognitionHistory& history) { write(history.tallies()); }
  template <class A, class B>
  void write(const std::pair<A, B>& pair) {
    (*this)(pair.first, pair.second);
  }
  template <class T>
  void write(const std::vector<T>& all) {
    writeEach(all);
  }
  template <class T>
  void write(const std::set<T>& all) {
    writeEach(all);
  }
  template <class K, class V>
  void write(const std::map<K, V>& all) {
    writeEach(all);
  }
  template <class K, class V>
  void write(const std::unordered_map<K, V>& all) {
    writeEach(std::map<K, V>(all.begin(), all.end()));  // sorted, so that equal states give equal bytes
  }
  template <class Container>
  void writeEach(const Container& all) {
    to_.put(static_cast<std::uint64_t>(all.size()));
    for (const auto& one : all) write(one);
  }

  ByteWriter to_;
};

/// Rejects words that MemoryWriter did not write.
class MemoryReader {
 public:
  explicit MemoryReader(std::span<const std::uint32_t> words) : from_(words) {}
  template <class... Values>
  void operator()(Values&... values) {
    (read(values), ...);
  }
  /// Reads the version, which must come first. False: of a later program.
  [[nodiscard]] bool readVersion() {
    version_ = from_.get<std::uint32_t>();
    return version_ >= 1 && version_ <= kMemoryVersion;
  }
  [[nodiscard]] std::uint32_t version() const { return version_; }
  [[nodiscard]] bool isAtEnd() const { return from_.isAtEnd(); }

 private:
  template <class Record>
  void read(Record& record) {
    describe(*this, record);
  }
  template <PlainValue T>
  void read(T& value) {
    value = from_.get<T>();
  }
  void read(bool& flag) { flag = from_.get<std::uint32_t>() != 0; }
  void read(std::string& text) {
    const std::vector<char> letters = from_.getList<char>();
    text.assign(letters.begin(), letters.end());
  }
  void read(Eigen::Vector3f& v) {
    v.setZero();
    from_.getAll(std::span<float>(v.data(), 3));
    if (!v.allFinite()) from_.refuse();
  }
  void read(Eigen::Isometry3d& T) {
    from_.getAll(std::span<double>(T.data(), 16));
    if (!T.matrix().allFinite()) from_.refuse();
  }
  void read(RegionSet& regions) {
    for (const RegionId region : from_.getList<RegionId>()) regions.add(region);
  }
  void read(cv::Mat& image) {
    int rows = 0, cols = 0, type = 0;
    (*this)(rows, cols, type);
    const auto isSide = [](int side) { return side > 0 && side < kLargestImageSide; };
    const bool is_image =
        isSide(rows) && isSide(cols) && (type == CV_8UC1 || type == CV_32FC1) &&
        static_cast<std::size_t>(rows) <= from_.bytesLeft() / static_cast<std::size_t>(cols);
    if (!is_image) return from_.refuse();
    image.create(rows, cols, type);
    const std::size_t row_bytes = static_cast<std::size_t>(cols) * image.elemSize();
    for (int row = 0; row < rows; ++row) from_.getAll(std::span<unsigned char>(image.ptr(row), row_bytes));
  }
  void read(std::optional<Intrinsics>& K) {
    const auto stored = from_.get<Intrinsics>();
    if (stored == Intrinsics{}) return K.reset();
    const auto isSide = [](int side) { return side > 0 && side < kLargestImageSide; };
    const auto isFocal = [](float focal) { return std::isfinite(focal) && focal > 0; };
    const bool is_camera = isFocal(stored.fx) && isFocal(stored.fy) && std::isfinite(stored.cx) &&
                           std::isfinite(stored.cy) && isSide(stored.width) && isSide(stored.height);
    if (!is_camera) return from_.refuse();
    K = stored;
  }
  void read(StoredView& view) {
    describe(*this, view);
    view.box_px = {view.box_px.tl(), view.mask.size()};
    const cv::Rect image({}, view.image_px);
    const bool is_view = view.mask.type() == CV_8UC1 && view.z_m.type() == CV_32FC1 && !view.mask.empty() &&
                         view.z_m.size() == view.mask.size() && view.image_px.width < kLargestImageSide &&
                         view.image_px.height < kLargestImageSide && (view.box_px & image) == view.box_px;
    const auto isMeasure = [](float value) { return std::isfinite(value) && value >= 0; };
    const ViewQuality& quality = view.quality;
    const bool is_quality = isMeasure(quality.pixels) && isMeasure(quality.sharpness) &&
                            isMeasure(quality.outline) && isMeasure(quality.hidden);
    if (!is_view || !is_quality) return from_.refuse();
    if (version_ < kWithQuality) view.quality.pixels = static_cast<float>(cv::countNonZero(view.mask));
  }
  void read(ViewSphere& views) {
    std::vector<Eigen::Vector3f> directions;
    read(directions);
    views = ViewSphere(std::move(directions));
  }
  void read(RecognitionHistory& history) {
    RecognitionHistory::Tallies tallies;
    read(tallies);
    history = RecognitionHistory(std::move(tallies));
  }
  template <class A, class B>
  void read(std::pair<A, B>& pair) {
    (*this)(pair.first, pair.second);
  }
  template <class T>
  void read(std::vector<T>& all) {
    readEach<T>([&](T&& one) { all.push_back(std::move(one)); });
  }
  template <class T>
  void read(std::set<T>& all) {
    readEach<T>([&](T&& one) { all.insert(std::move(one)); });
  }
  template <class K, class V>
  void read(std::map<K, V>& all) {
    readEach<std::pair<K, V>>([&](std::pair<K, V>&& one) { all.insert(std::move(one)); });
  }
  template <class K, class V>
  void read(std::unordered_map<K, V>& all) {
    readEach<std::pair<K, V>>([&](std::pair<K, V>&& one) { all.insert(std::move(one)); });
  }
  template <class T, class Take>
  void readEach(const Take& take) {
    const auto count = from_.get<std::uint64_t>();
    for (std::uint64_t i = 0; i < count && from_.ok(); ++i) {
      T one{};
      read(one);
      take(std::move(one));
    }
  }

  ByteReader from_;
  std::uint32_t version_ = 0;
};

}  // namespace

std::vector<std::uint32_t> collectorMemory(const CollectorState& state) {
  MemoryWriter to;
  to(kMemoryVersion, state);
  return to.take();
}

std::optional<CollectorState> collectorStateFrom(std::span<const std::uint32_t> words) {
  MemoryReader from(words);
  if (!from.readVersion()) return std::nullopt;
  CollectorState state;
  from(state);
  if (!from.isAtEnd()) return std::nullopt;
  return state;
}

Result<void> checkObjects(const CollectorState& state, const CatalogueMirror& catalogue) {
  for (const auto& [key, id] : state.catalogue.ids) {
    if (!catalogue.hasHad(key))
      return fail(
          "The catalogue does not have object " + std::to_string(id.value) + ", which this scan added to it.",
          "Put back the catalogue that the scan was made with.");
  }
  return {};
}

}  // namespace scantrove
