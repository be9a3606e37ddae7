#include "core/compute/kernel_cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <map>
#include <optional>

#include "core/compute/cached_kernels.h"
#include "core/compute/private_folder.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kLibrary = "AB/PROGRAM/reduce/64-1-1/reduce.so";
constexpr const char* kBitcode = "AB/PROGRAM/program.bc";

/// Bitcode with a block of one word and a block of two.
std::string bitcode() {
  std::string bytes;
  for (const std::uint32_t word : {0xDEC04342U, 0xC35U, 1U, 7U, 0xC21U, 2U, 8U, 9U})
    bytes.append(reinterpret_cast<const char*>(&word), sizeof(word));
  return bytes;
}

/// Puts the cache folder and TMPDIR into a folder of the test; restores the environment.
class KernelCacheTest : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"POCL_CACHE_DIR", "XDG_CACHE_HOME", "HOME", "TMPDIR"}) {
      const char* value = std::getenv(name);
      before_[name] = value == nullptr ? std::nullopt : std::optional<std::string>(value);
    }
    ::unsetenv("POCL_CACHE_DIR");
    ::setenv("XDG_CACHE_HOME", (folder_ / "cache").c_str(), 1);
    fs::create_directory(folder_ / "tmp");
    ::setenv("TMPDIR", (folder_ / "tmp").c_str(), 1);
  }
  void TearDown() override {
    for (const auto& [name, value] : before_)
      value ? ::setenv(name.c_str(), value->c_str(), 1) : ::unsetenv(name.c_str());
  }

  [[nodiscard]] fs::path own() const { return folder_ / "cache/scantrove/kernels"; }
  [[nodiscard]] bool isPrivate(const KernelCache& cache) const {
    return cache.folder().parent_path() == folder_ / "tmp";
  }
  void fill(const fs::path& cache) const {
    fs::create_directories((cache / kLibrary).parent_path());
    fs::copy_file("/proc/self/exe", cache / kLibrary);
    std::ofstream(cache / kBitcode, std::ios::binary) << bitcode();
  }
  static void overwrite(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
  }

  TemporaryFolder folder_;

 private:
  std::map<std::string, std::optional<std::string>> before_;
};

TEST_F(KernelCacheTest, UsesOwnFolder_WhenItCanBeWritten) {
  const KernelCache cache;
  EXPECT_EQ(cache.folder(), own());
  EXPECT_STREQ(std::getenv("POCL_CACHE_DIR"), own().c_str());
  EXPECT_FALSE(cache.remark());
}

TEST_F(KernelCacheTest, UsesPrivateFolderAndRemovesIt_WhenCacheCannotBeWritten) {
  for (const auto& [name, value] :
       {std::pair("XDG_CACHE_HOME", "/proc"), {"POCL_CACHE_DIR", "/proc/kernels"}}) {
    ::setenv(name, value, 1);
    fs::path folder;
    {
      const KernelCache cache;
      folder = cache.folder();
      EXPECT_TRUE(isPrivate(cache)) << folder;
      struct stat status {};
      ASSERT_EQ(::stat(folder.c_str(), &status), 0);
      EXPECT_EQ(status.st_mode & 0777U, 0700U);
      ASSERT_TRUE(cache.remark());
      EXPECT_THAT(cache.remark()->message(),
                  testing::AllOf(HasSubstr("/proc"), HasSubstr("compiled anew"), HasSubstr(name)));
      fill(folder);
    }
    EXPECT_FALSE(fs::exists(folder));
  }
}

TEST_F(KernelCacheTest, UsesPrivateFolder_WhenNoHomeIsSet) {
  ::unsetenv("XDG_CACHE_HOME");
  ::unsetenv("HOME");
  EXPECT_TRUE(isPrivate(KernelCache()));
}

TEST_F(KernelCacheTest, TreatsEmptyVariablesAsUnset) {
  ::setenv("POCL_CACHE_DIR", "", 1);
  EXPECT_EQ(KernelCache().folder(), own());
  ::setenv("POCL_CACHE_DIR", "", 1);
  ::setenv("XDG_CACHE_HOME", "", 1);
  ::setenv("HOME", (folder_ / "home").c_str(), 1);
  EXPECT_EQ(KernelCache().folder(), folder_ / "home/.cache/scantrove/kernels");
}

TEST_F(KernelCacheTest, RemovesDamagedFiles_FromItsOwnFolder) {
  for (const std::string& damage : {std::string(), std::string("garbage"), bitcode().substr(0, 20)}) {
    fs::remove_all(own());
    fill(own());
    overwrite(own() / kBitcode, damage);
    ::unsetenv("POCL_CACHE_DIR");
    const KernelCache cache;
    EXPECT_EQ(cache.folder(), own());
    ASSERT_TRUE(cache.remark()) << damage;
    EXPECT_THAT(cache.remark()->message(), HasSubstr("damaged"));
    EXPECT_FALSE(fs::exists(own() / kBitcode));
    EXPECT_TRUE(fs::exists(own() / kLibrary));
  }
}

TEST_F(KernelCacheTest, KeepsDamagedFiles_InAForeignFolder) {
  const fs::path others = folder_ / "others";
  fill(others);
  overwrite(others / kLibrary, "");
  ::setenv("POCL_CACHE_DIR", others.c_str(), 1);
  const KernelCache cache;
  EXPECT_TRUE(isPrivate(cache));
  EXPECT_THAT(cache.remark().value_or(Error{}).message(), HasSubstr(others.string()));
  EXPECT_TRUE(fs::exists(others / kLibrary));
}

TEST_F(KernelCacheTest, FindsDamageInFiles_OfAnEarlierRun) {
  fill(own());
  { const KernelCache first; }
  EXPECT_THAT(damagedKernels(own()).value(), IsEmpty());
  {
    std::fstream library(own() / kLibrary, std::ios::in | std::ios::out | std::ios::binary);
    library.seekp(20000) << "damage";
  }
  EXPECT_TRUE(isCompleteKernel(own() / kLibrary));
  EXPECT_THAT(damagedKernels(own()).value(), ElementsAre(own() / kLibrary));
}

TEST_F(KernelCacheTest, FindsTruncatedFiles) {
  fill(own());
  const std::string library = readText(own() / kLibrary);
  for (const std::size_t size : {std::size_t{0}, std::size_t{63}, library.size() / 2, library.size() - 1}) {
    overwrite(own() / kLibrary, library.substr(0, size));
    EXPECT_FALSE(isCompleteKernel(own() / kLibrary)) << size;
  }
  for (std::size_t size = 0; size < bitcode().size(); ++size) {
    overwrite(own() / kBitcode, bitcode().substr(0, size));
    EXPECT_EQ(isCompleteKernel(own() / kBitcode), size == 16) << size;  // the end of the first block
  }
}

TEST_F(KernelCacheTest, RemovesAbandonedPrivateFolders_ButNothingElse) {
  const fs::path abandoned = folder_ / "tmp/scantrove-kernels-abcdef",
                 others = folder_ / "tmp/scantrove-kernels-backup";
  fs::create_directory(abandoned);
  fs::create_directory(others);
  overwrite(abandoned / ".scantrove-private-kernels", "");
  const auto first = makePrivateFolder();
  const auto second = makePrivateFolder();
  ASSERT_TRUE(first && second);
  EXPECT_FALSE(fs::exists(abandoned));
  EXPECT_TRUE(fs::exists(others));
  EXPECT_TRUE(fs::exists(*first)) << "in use";
  removePrivateFolder(others);
  EXPECT_TRUE(fs::exists(others));
  removePrivateFolder(*first);
  EXPECT_FALSE(fs::exists(*first));
  removePrivateFolder(*second);
}

}  // namespace
}  // namespace scantrove::test
