#include "core/capture/containers/decompression.h"

#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>
#include <string>

namespace scantrove {

namespace {

tl::unexpected<Error> damagedFrame(const char* kind) {
  return fail(std::string("data compressed by ") + kind + " are damaged");
}

Result<ByteBlock> decompressLz4(ByteView bytes, std::size_t size) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) return damagedFrame("lz4");
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> owner(
      context, &LZ4F_freeDecompressionContext);
  ByteBlock out(size);
  std::size_t read = 0, written = 0;
  while (read < bytes.size()) {
    std::size_t in_left = bytes.size() - read, out_left = out.size() - written;
    const std::size_t more =
        LZ4F_decompress(context, out.data() + written, &out_left, bytes.data() + read, &in_left, nullptr);
    if (LZ4F_isError(more) != 0 || (in_left == 0 && out_left == 0)) break;
    read += in_left;
    written += out_left;
    if (more == 0) break;
  }
  if (written != size) return damagedFrame("lz4");
  return out;
}

Result<ByteBlock> decompressBz2(ByteView bytes, std::size_t size) {
  ByteBlock out(size);
  auto written = static_cast<unsigned>(size);
  // The library only reads its source.
  auto* const source = const_cast<char*>(reinterpret_cast<const char*>(bytes.data()));
  const int code = BZ2_bzBuffToBuffDecompress(reinterpret_cast<char*>(out.data()), &written, source,
                                              static_cast<unsigned>(bytes.size()), 0, 0);
  if (code != BZ_OK || written != size) return damagedFrame("bz2");
  return out;
}

}  // namespace

Result<Compression> compressionNamed(std::string_view name) {
  if (name.empty() || name == "none") return Compression::none;
  if (name == "lz4") return Compression::lz4;
  if (name == "zstd") return Compression::zstd;
  if (name == "bz2") return Compression::bz2;
  return fail("the compression '" + std::string(name.substr(0, 20)) + "' is unknown");
}

bool isZstd(ByteView bytes) {
  return bytes.size() >= 4 && bytes[0] == 0x28 && bytes[1] == 0xB5 && bytes[2] == 0x2F && bytes[3] == 0xFD;
}

Result<ByteBlock> decompress(Compression compression, ByteView bytes, std::uint64_t size) {
  constexpr std::uint64_t kMaxLz4Ratio = 256;
  if (size > kMaxDecompressedBytes || bytes.size() > kMaxDecompressedBytes) {
    return fail("a chunk of " + std::to_string(size >> 20) + " MB is larger than 128 MB");
  }
  switch (compression) {
    case Compression::none:
      if (bytes.size() != size) return fail("a chunk has not the size that it announces");
      return ByteBlock(bytes.begin(), bytes.end());
    case Compression::lz4:
      if (size > bytes.size() * kMaxLz4Ratio) return damagedFrame("lz4");
      return decompressLz4(bytes, static_cast<std::size_t>(size));
    case Compression::bz2:
      return decompressBz2(bytes, static_cast<std::size_t>(size));
    case Compression::zstd:
      break;
  }
  Result<ByteBlock> out = decompressZstdStart(bytes, size);
  if (out && out->size() != size) return damagedFrame("zstd");
  return out;
}

Result<ByteBlock> decompressZstdStart(ByteView bytes, std::uint64_t limit) {
  constexpr std::size_t kFirstPiece = 64 << 10;
  const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(),
                                                                          &ZSTD_freeDStream);
  // A frame may ask for a window of gigabytes.
  constexpr int kMaxWindowLog = 27;
  if (!stream || ZSTD_isError(ZSTD_DCtx_setParameter(stream.get(), ZSTD_d_windowLogMax, kMaxWindowLog)) != 0)
    return damagedFrame("zstd");
  limit = std::min(limit, kMaxDecompressedBytes);
  ByteBlock out;
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  std::size_t written = 0;
  while (written < limit) {
    if (written == out.size())
      out.resize(
          static_cast<std::size_t>(std::min<std::uint64_t>(limit, std::max(kFirstPiece, out.size() * 2))));
    ZSTD_outBuffer to{out.data(), out.size(), written};
    const std::size_t read_before = in.pos;
    const std::size_t more = ZSTD_decompressStream(stream.get(), &to, &in);
    if (ZSTD_isError(more) != 0) return damagedFrame("zstd");
    const bool is_stuck = to.pos == written && in.pos == read_before;
    written = to.pos;
    if (more == 0) break;
    if (is_stuck) return damagedFrame("zstd");
  }
  out.resize(written);
  return out;
}

}  // namespace scantrove
