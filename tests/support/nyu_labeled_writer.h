#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/evaluation/hdf5_handle.h"

namespace scantrove::test {

/// A labelled image as MATLAB has it, before it stores it.
struct LabeledImage {
  std::string scene, depth_file;
  cv::Mat1w labels;
  cv::Mat1b instances;
  cv::Mat1f depth_m;
};

/// Writes a small file in the layout of nyu_depth_v2_labeled.mat: HDF5 behind the 512 bytes of MATLAB's own
/// header, arrays with their dimensions reversed, in compressed chunks, and cells as references to texts of
/// 16 bits in the group #refs#. Throws std::runtime_error.
class NyuLabeledWriter {
 public:
  static void write(const std::filesystem::path& path, const std::vector<LabeledImage>& images) {
    {
      const NyuLabeledWriter writer(path);
      writer.arrays(images);
      std::vector<std::string> files, scenes;
      for (const LabeledImage& image : images) {
        files.push_back(image.depth_file);
        scenes.push_back(image.scene);
      }
      writer.cells("rawDepthFilenames", files, 'a');
      writer.cells("scenes", scenes, 'b');
    }
    std::string header =
        "MATLAB 7.3 MAT-file, Platform: GLNXA64, Created on: Mon Jan  1 00:00:00 2018 HDF5 schema 1.00 .";
    header.resize(124, ' ');
    header += std::string({'\0', '\2', 'I', 'M'});
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    file.write(header.data(), static_cast<std::streamsize>(header.size()));
    if (!file) throw std::runtime_error("cannot write " + path.string());
  }

 private:
  explicit NyuLabeledWriter(const std::filesystem::path& path) {
    const Hdf5Properties properties(H5Pcreate(H5P_FILE_CREATE));
    check(H5Pset_userblock(properties.id(), 512));
    file_ = Hdf5File(checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, properties.id(), H5P_DEFAULT)));
    const Hdf5Handle<H5Gclose> group(
        checked(H5Gcreate2(file_.id(), "#refs#", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)));
  }

  static void check(herr_t status) {
    if (status < 0) throw std::runtime_error("HDF5 failed");
  }
  static hid_t checked(hid_t id) {
    if (id < 0) throw std::runtime_error("HDF5 failed");
    return id;
  }

  void attribute(const Hdf5Dataset& dataset, const char* name, const std::string& text) const {
    const Hdf5Type type(checked(H5Tcopy(H5T_C_S1)));
    check(H5Tset_size(type.id(), text.size()));
    const Hdf5Space space(checked(H5Screate(H5S_SCALAR)));
    const Hdf5Handle<H5Aclose> attribute(
        checked(H5Acreate2(dataset.id(), name, type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT)));
    check(H5Awrite(attribute.id(), type.id(), text.data()));
  }

  /// An array of MATLAB with the dimensions `shape`: HDF5 counts them from the last one.
  template <class Value>
  Hdf5Dataset numbers(const std::string& name, std::vector<hsize_t> shape, std::vector<hsize_t> chunk,
                      hid_t type, const std::vector<Value>& values, const char* matlab_class) const {
    const Hdf5Space space(checked(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr)));
    const Hdf5Properties properties(H5Pcreate(H5P_DATASET_CREATE));
    if (!chunk.empty()) {
      check(H5Pset_chunk(properties.id(), static_cast<int>(chunk.size()), chunk.data()));
      check(H5Pset_deflate(properties.id(), 3));
    }
    Hdf5Dataset dataset(checked(
        H5Dcreate2(file_.id(), name.c_str(), type, space.id(), H5P_DEFAULT, properties.id(), H5P_DEFAULT)));
    check(H5Dwrite(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
    attribute(dataset, "MATLAB_class", matlab_class);
    return dataset;
  }

  template <class Value, class Member>
  void array(const char* name, const std::vector<LabeledImage>& images, Member member, hid_t type,
             const char* matlab_class) const {
    const auto rows = static_cast<hsize_t>((images.front().*member).rows);
    const auto columns = static_cast<hsize_t>((images.front().*member).cols);
    std::vector<Value> values;
    for (const LabeledImage& image : images) {
      // MATLAB: the row changes fastest, then the column, then the image.
      for (int x = 0; x < static_cast<int>(columns); ++x) {
        for (int y = 0; y < static_cast<int>(rows); ++y) values.push_back((image.*member)(y, x));
      }
    }
    numbers(name, {images.size(), columns, rows}, {1, (columns + 1) / 2, rows}, type, values, matlab_class);
  }

  void arrays(const std::vector<LabeledImage>& images) const {
    array<std::uint16_t>("labels", images, &LabeledImage::labels, H5T_STD_U16LE, "uint16");
    array<std::uint8_t>("instances", images, &LabeledImage::instances, H5T_STD_U8LE, "uint8");
    array<float>("depths", images, &LabeledImage::depth_m, H5T_IEEE_F32LE, "single");
  }

  void cells(const char* name, const std::vector<std::string>& texts, char first) const {
    std::vector<hobj_ref_t> references(texts.size());
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const std::string place = std::string("/#refs#/") + first + std::to_string(i);
      const std::vector<std::uint16_t> characters(texts[i].begin(), texts[i].end());
      const Hdf5Dataset text = numbers(place, {characters.size(), 1}, {}, H5T_STD_U16LE, characters, "char");
      check(H5Rcreate(&references[i], file_.id(), place.c_str(), H5R_OBJECT, -1));
    }
    numbers(name, {1, texts.size()}, {}, H5T_STD_REF_OBJ, references, "cell");
  }

  Hdf5File file_;
};

}  // namespace scantrove::test
