// nyu_depth_v2_labeled.mat: the layout of MATLAB 7.3, and files that are something else.
#include "core/evaluation/nyu_labeled_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/nyu_labeled_writer.h"
#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Images of 5 columns and 3 rows whose values name their place.
std::vector<test::LabeledImage> numberedImages(int count) {
  std::vector<test::LabeledImage> images;
  for (int i = 0; i < count; ++i) {
    const std::string scene = "study_000" + std::to_string(i + 1);
    test::LabeledImage image{scene, scene + "a/d-1.5-" + std::to_string(i) + ".pgm", cv::Mat1w(3, 5),
                             cv::Mat1b(3, 5), cv::Mat1f(3, 5)};
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 5; ++x) {
        image.labels(y, x) = static_cast<std::uint16_t>(1000 * i + 10 * y + x);
        image.instances(y, x) = static_cast<std::uint8_t>(100 * i + 10 * x + y);
        image.depth_m(y, x) =
            static_cast<float>(i) + 0.1F * static_cast<float>(y) + 0.01F * static_cast<float>(x);
      }
    }
    images.push_back(image);
  }
  return images;
}

std::string openError(const std::filesystem::path& file) {
  const auto labeled = NyuLabeledFile::open(file);
  return labeled ? "(opened)" : labeled.error().message();
}

/// Replaces a word in a file by another of equal length.
void replaceWord(const std::filesystem::path& file, const std::string& word, const std::string& other) {
  ASSERT_EQ(word.size(), other.size());
  std::string bytes = test::readText(file);
  const std::size_t at = bytes.find(word);
  ASSERT_NE(at, std::string::npos) << word;
  bytes.replace(at, word.size(), other);
  std::ofstream(file, std::ios::binary) << bytes;
}

TEST(NyuLabeledFile, ReturnsImagesUpright_AsMatlabStoresThemTransposed) {
  const test::TemporaryFolder folder;
  const auto images = numberedImages(3);
  test::NyuLabeledWriter::write(folder / "labeled.mat", images);
  const auto file = NyuLabeledFile::open(folder / "labeled.mat");
  ASSERT_TRUE(file) << file.error().message();
  EXPECT_EQ(file->imageSize(), cv::Size(5, 3));
  ASSERT_EQ(file->origins().size(), 3U);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto labels = file->labels(i);
    const auto instances = file->instances(i);
    const auto depth = file->depth(i);
    ASSERT_TRUE(labels && instances && depth);
    EXPECT_EQ(cv::norm(*labels, images[i].labels, cv::NORM_INF), 0);
    EXPECT_EQ((*instances)(2, 4), 100 * i + 42);
    EXPECT_EQ(cv::norm(*depth, images[i].depth_m, cv::NORM_INF), 0);
  }
  EXPECT_EQ((*file->labels(2))(1, 4), 2014);
}

TEST(NyuLabeledFile, ReadsCellsOfTexts) {
  const test::TemporaryFolder folder;
  test::NyuLabeledWriter::write(folder / "labeled.mat", numberedImages(2));
  const auto file = NyuLabeledFile::open(folder / "labeled.mat");
  ASSERT_TRUE(file) << file.error().message();
  EXPECT_EQ(file->origins()[1].scene, "study_0002");
  EXPECT_EQ(file->origins()[1].depth_file, "study_0002a/d-1.5-1.pgm");
}

TEST(NyuLabeledFile, IsNamed_WhenItIsMissingOrSomethingElse) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(openError(folder / "none.mat"), HasSubstr("none.mat"));
  folder.write("empty.mat", "");
  folder.write("old.mat", "MATLAB 5.0 MAT-file, Platform: GLNXA64" + std::string(2000, ' '));
  for (const char* name : {"empty.mat", "old.mat"})
    EXPECT_THAT(openError(folder / name), AllOf(HasSubstr(name), HasSubstr("HDF5")));
}

TEST(NyuLabeledFile, NamesTheArray_WhenOneIsMissing) {
  const test::TemporaryFolder folder;
  for (const auto& [word, other] : {std::pair<std::string, std::string>{"instances", "distances"},
                                    {"rawDepthFilenames", "rawColorFilenames"},
                                    {"scenes", "scapes"}}) {
    test::NyuLabeledWriter::write(folder / "labeled.mat", numberedImages(2));
    replaceWord(folder / "labeled.mat", word, other);
    EXPECT_THAT(openError(folder / "labeled.mat"), AllOf(HasSubstr("labeled.mat"), HasSubstr(word)));
  }
}

TEST(NyuLabeledFile, NamesItself_WhenTruncatedAnywhere) {
  const test::TemporaryFolder folder;
  test::NyuLabeledWriter::write(folder / "labeled.mat", numberedImages(3));
  const std::string bytes = test::readText(folder / "labeled.mat");
  for (std::size_t size = 512; size < bytes.size(); size += bytes.size() / 23) {
    folder.write("cut.mat", bytes.substr(0, size));
    EXPECT_THAT(openError(folder / "cut.mat"), HasSubstr("cut.mat")) << size;
  }
}

TEST(NyuLabeledFile, NamesTheImage_WhenItsBytesAreDamaged) {
  const test::TemporaryFolder folder;
  test::NyuLabeledWriter::write(folder / "labeled.mat", numberedImages(2));
  std::string bytes = test::readText(folder / "labeled.mat");
  const std::string start_of_stream = "\x78\x5E";  // zlib, level 3
  int streams = 0;
  for (std::size_t at = 0; (at = bytes.find(start_of_stream, at)) != std::string::npos; ++streams)
    bytes.replace(at, 2, 2, '\0');
  ASSERT_GE(streams, 12) << "two chunks for each image of three arrays";
  folder.write("labeled.mat", bytes);
  const auto file = NyuLabeledFile::open(folder / "labeled.mat");
  ASSERT_TRUE(file) << file.error().message();
  const auto labels = file->labels(1);
  ASSERT_FALSE(labels);
  EXPECT_THAT(labels.error().message(), AllOf(HasSubstr("Image 2"), HasSubstr("'labels'"),
                                              HasSubstr("labeled.mat"), HasSubstr("damaged")));
}

// HDF5 copies a whole chunk, however little a stream unpacks to.
TEST(NyuLabeledFile, NamesTheImage_WhenAChunkUnpacksToLess) {
  const test::TemporaryFolder folder;
  test::NyuLabeledWriter::write(folder / "labeled.mat", numberedImages(2));
  std::string bytes = test::readText(folder / "labeled.mat");
  // zlib: header, one last stored block of two zeros, their Adler-32: 1 + 0 + 0, and 1 + 1.
  const std::string two_zeros("\x78\x01\x01\x02\x00\xFD\xFF\x00\x00\x00\x02\x00\x01", 13);
  const std::string start_of_stream = "\x78\x5E";
  for (std::size_t at = 0; (at = bytes.find(start_of_stream, at)) != std::string::npos;
       at += two_zeros.size())
    bytes.replace(at, two_zeros.size(), two_zeros);
  folder.write("labeled.mat", bytes);
  const auto file = NyuLabeledFile::open(folder / "labeled.mat");
  ASSERT_TRUE(file) << file.error().message();
  const auto labels = file->labels(0);
  ASSERT_FALSE(labels);
  EXPECT_THAT(labels.error().message(), AllOf(HasSubstr("Image 1"), HasSubstr("labeled.mat")));
}

TEST(NyuLabeledFile, RefusesNamesOutsideTheRawFolder) {
  const test::TemporaryFolder folder;
  for (const char* name : {"../../secret/d-1.5-1.pgm", "/etc/d-1.5-1.pgm"}) {
    std::vector<test::LabeledImage> images = numberedImages(1);
    images.front().depth_file = name;
    test::NyuLabeledWriter::write(folder / "labeled.mat", images);
    EXPECT_THAT(openError(folder / "labeled.mat"), HasSubstr("outside")) << name;
  }
}

TEST(NyuLabeledFile, RefusesArrays_WhenTheirSizesDiffer) {
  const test::TemporaryFolder folder;
  std::vector<test::LabeledImage> images = numberedImages(2);
  for (test::LabeledImage& image : images) image.instances = cv::Mat1b(3, 4, std::uint8_t{1});
  test::NyuLabeledWriter::write(folder / "labeled.mat", images);
  EXPECT_THAT(openError(folder / "labeled.mat"), HasSubstr("differ in size"));
}

}  // namespace
}  // namespace scantrove
