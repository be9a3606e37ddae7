#include "core/evaluation/nyu_labeled_file.h"

#include <array>
#include <cstdint>
#include <optional>
#include <system_error>
#include <utility>

#include "core/base/check.h"
#include "core/base/regular_file.h"
#include "core/evaluation/hdf5_chunks.h"
#include "core/evaluation/hdf5_handle.h"

namespace scantrove {
/// An array of numbers in the file.
struct NyuNumberArray {
  Hdf5Dataset dataset;
  std::array<hsize_t, 3> shape{};  ///< images, columns, rows
};

namespace {

constexpr hsize_t kLongestSide_px = 8192;
constexpr hsize_t kMostImages = 100'000;
constexpr hsize_t kLongestName = 4096;
constexpr const char* kDownloadAdvice = "Download nyu_depth_v2_labeled.mat again.";

std::vector<hsize_t> shapeOf(const Hdf5Dataset& dataset) {
  const Hdf5Space space(H5Dget_space(dataset.id()));
  const int rank = space ? H5Sget_simple_extent_ndims(space.id()) : -1;
  if (rank < 1 || rank > H5S_MAX_RANK) return {};
  std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
  if (H5Sget_simple_extent_dims(space.id(), shape.data(), nullptr) != rank) return {};
  return shape;
}

H5T_class_t classOf(const Hdf5Dataset& dataset) {
  const Hdf5Type type(H5Dget_type(dataset.id()));
  return type ? H5Tget_class(type.id()) : H5T_NO_CLASS;
}

/// Whether HDF5 reads the whole array within its buffers; see hdf5_chunks.h.
bool isSafeToReadWhole(const Hdf5Dataset& dataset, hsize_t file_bytes) {
  const std::vector<hsize_t> shape = shapeOf(dataset), start(shape.size(), 0);
  return !shape.empty() && hasSafeForm(dataset) && isSafeToRead(dataset, {start, shape}, file_bytes);
}

Hdf5Dataset openDataset(const Hdf5File& file, const char* name) {
  return Hdf5Dataset(H5Dopen2(file.id(), name, H5P_DEFAULT));
}

Result<NyuNumberArray> openArray(const Hdf5File& file, const char* name, H5T_class_t of_class,
                                 const std::string& path) {
  NyuNumberArray array;
  array.dataset = openDataset(file, name);
  if (!array.dataset) return fail(path + " has no array '" + name + "'.", kDownloadAdvice);
  const std::vector<hsize_t> shape = shapeOf(array.dataset);
  if (shape.size() != 3 || classOf(array.dataset) != of_class || !hasSafeForm(array.dataset)) {
    return fail("The array '" + std::string(name) + "' of " + path + " has another form than in NYUv2.",
                kDownloadAdvice);
  }
  std::ranges::copy(shape, array.shape.begin());
  return array;
}

/// The text of a dataset that a cell of MATLAB refers to: one number of 16 bits for each character.
std::optional<std::string> textOf(const Hdf5File& file, hobj_ref_t reference, hsize_t file_bytes) {
  const Hdf5Dataset dataset(H5Rdereference2(file.id(), H5P_DEFAULT, H5R_OBJECT, &reference));
  if (!dataset || H5Iget_type(dataset.id()) != H5I_DATASET) return std::nullopt;
  hsize_t length = 1;
  for (const hsize_t side : shapeOf(dataset)) length = side > kLongestName ? side : length * side;
  if (length == 0 || length > kLongestName || classOf(dataset) != H5T_INTEGER ||
      !isSafeToReadWhole(dataset, file_bytes)) {
    return std::nullopt;
  }
  const Hdf5Space space(H5Dget_space(dataset.id()));
  if (!space || H5Sget_simple_extent_npoints(space.id()) != static_cast<hssize_t>(length))
    return std::nullopt;
  std::vector<std::uint16_t> characters(length);
  if (H5Dread(dataset.id(), H5T_NATIVE_UINT16, H5S_ALL, H5S_ALL, H5P_DEFAULT, characters.data()) < 0)
    return std::nullopt;
  std::string text;
  for (const std::uint16_t character : characters) {
    if (character < ' ' || character > '~') return std::nullopt;  // names of NYUv2 are plain ASCII
    text.push_back(static_cast<char>(character));
  }
  return text;
}

/// The texts of a cell array with `count` cells.
Result<std::vector<std::string>> readTexts(const Hdf5File& file, const char* name, hsize_t count,
                                           const std::string& path, hsize_t file_bytes) {
  const Hdf5Dataset dataset = openDataset(file, name);
  if (!dataset) return fail(path + " has no list '" + name + "'.", kDownloadAdvice);
  const std::string list = "The list '" + std::string(name) + "' of " + path;
  const Hdf5Space space(H5Dget_space(dataset.id()));
  const Hdf5Type type(H5Dget_type(dataset.id()));
  const bool are_references = type && H5Tequal(type.id(), H5T_STD_REF_OBJ) > 0;
  if (!space || !are_references || H5Sget_simple_extent_npoints(space.id()) != static_cast<hssize_t>(count) ||
      !isSafeToReadWhole(dataset, file_bytes)) {
    return fail(list + " has no text for each image.", kDownloadAdvice);
  }
  std::vector<hobj_ref_t> references(count);
  if (H5Dread(dataset.id(), H5T_STD_REF_OBJ, H5S_ALL, H5S_ALL, H5P_DEFAULT, references.data()) < 0)
    return fail(list + " is damaged.", kDownloadAdvice);
  std::vector<std::string> texts;
  for (const hobj_ref_t reference : references) {
    auto text = textOf(file, reference, file_bytes);
    if (!text) {
      return fail(list + ": text " + std::to_string(texts.size() + 1) + " is damaged.", kDownloadAdvice);
    }
    texts.push_back(std::move(*text));
  }
  return texts;
}

/// Whether `name` stays inside the folder that it is joined to.
bool isRelativeName(const std::string& name) {
  const std::filesystem::path path(name);
  return path.is_relative() && std::ranges::none_of(path, [](const auto& part) { return part == ".."; });
}

}  // namespace

struct NyuLabeledFile::Contents {
  std::string path;
  hsize_t bytes = 0;  ///< of the file, when it was opened
  Hdf5File file;
  NyuNumberArray labels, instances, depths;

  /// Image `number` as it is seen: HDF5 has columns where the image has rows.
  template <class Value>
  [[nodiscard]] Result<cv::Mat_<Value>> read(const NyuNumberArray& array, std::size_t number, hid_t type,
                                             const char* name) const {
    SCANTROVE_CHECK(number < array.shape[0]);
    const Hdf5Silence quiet;
    cv::Mat_<Value> columns(static_cast<int>(array.shape[1]), static_cast<int>(array.shape[2]));
    const std::array<hsize_t, 3> start{number, 0, 0}, count{1, array.shape[1], array.shape[2]};
    const Hdf5Space in_file(H5Dget_space(array.dataset.id()));
    const Hdf5Space in_memory(H5Screate_simple(3, count.data(), nullptr));
    const bool is_read =
        in_file && in_memory && isSafeToRead(array.dataset, {start, count}, bytes) &&
        H5Sselect_hyperslab(in_file.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) >=
            0 &&
        H5Dread(array.dataset.id(), type, in_memory.id(), in_file.id(), H5P_DEFAULT, columns.data) >= 0;
    if (!is_read) {
      return fail("Image " + std::to_string(number + 1) + " of the array '" + name + "' in " + path +
                      " cannot be read: the file is damaged or truncated.",
                  kDownloadAdvice);
    }
    return cv::Mat_<Value>(columns.t());
  }
};

NyuLabeledFile::NyuLabeledFile(std::unique_ptr<Contents> contents) : contents_(std::move(contents)) {}
NyuLabeledFile::NyuLabeledFile(NyuLabeledFile&&) noexcept = default;
NyuLabeledFile& NyuLabeledFile::operator=(NyuLabeledFile&&) noexcept = default;
NyuLabeledFile::~NyuLabeledFile() = default;

Result<NyuLabeledFile> NyuLabeledFile::open(const std::filesystem::path& file) {
  SCANTROVE_TRY(checkRegularFile(file));
  const Hdf5Silence quiet;
  auto contents = std::make_unique<Contents>();
  contents->path = file.string();
  std::error_code unknown;
  contents->bytes = std::filesystem::file_size(file, unknown);
  if (unknown) return fail(contents->path + " cannot be read: " + unknown.message() + ".", kDownloadAdvice);
  contents->file = Hdf5File(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  if (!contents->file) {
    return fail(
        contents->path + " cannot be opened as a MATLAB 7.3 file (HDF5): it is damaged or another file.",
        "Give nyu_depth_v2_labeled.mat.");
  }
  const std::string& path = contents->path;
  SCANTROVE_TRY(moveInto(contents->labels, openArray(contents->file, "labels", H5T_INTEGER, path)));
  SCANTROVE_TRY(moveInto(contents->instances, openArray(contents->file, "instances", H5T_INTEGER, path)));
  SCANTROVE_TRY(moveInto(contents->depths, openArray(contents->file, "depths", H5T_FLOAT, path)));
  const std::array<hsize_t, 3> shape = contents->labels.shape;
  if (contents->instances.shape != shape || contents->depths.shape != shape)
    return fail("The arrays labels, instances and depths of " + path + " differ in size.", kDownloadAdvice);
  const auto [count, columns, rows] = shape;
  if (count < 1 || columns < 1 || rows < 1 || count > kMostImages || columns > kLongestSide_px ||
      rows > kLongestSide_px) {
    return fail(path + " has " + std::to_string(count) + " images of " + std::to_string(columns) + "x" +
                    std::to_string(rows) + " pixels, which NYUv2 cannot have.",
                kDownloadAdvice);
  }
  auto files = readTexts(contents->file, "rawDepthFilenames", count, path, contents->bytes);
  if (!files) return fail(files.error());
  auto scenes = readTexts(contents->file, "scenes", count, path, contents->bytes);
  if (!scenes) return fail(scenes.error());
  NyuLabeledFile labeled(std::move(contents));
  labeled.size_ = {static_cast<int>(columns), static_cast<int>(rows)};
  for (std::size_t i = 0; i < files->size(); ++i) {
    NyuOrigin origin{std::move((*scenes)[i]), std::move((*files)[i])};
    if (!isRelativeName(origin.depth_file) || !isRelativeName(origin.scene)) {
      return fail(labeled.contents_->path + ": the raw depth image of image " + std::to_string(i + 1) +
                      " lies outside its folder (" + origin.depth_file + ").",
                  kDownloadAdvice);
    }
    labeled.origins_.push_back(std::move(origin));
  }
  return labeled;
}

Result<cv::Mat1w> NyuLabeledFile::labels(std::size_t image) const {
  return contents_->read<std::uint16_t>(contents_->labels, image, H5T_NATIVE_UINT16, "labels");
}

Result<cv::Mat1w> NyuLabeledFile::instances(std::size_t image) const {
  return contents_->read<std::uint16_t>(contents_->instances, image, H5T_NATIVE_UINT16, "instances");
}

Result<cv::Mat1f> NyuLabeledFile::depth(std::size_t image) const {
  return contents_->read<float>(contents_->depths, image, H5T_NATIVE_FLOAT, "depths");
}

}  // namespace scantrove
