#include "core/session/evidence_bytes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace scantrove {
namespace {

constexpr std::size_t kEvidenceFloats = 23;
/// Earlier versions lacked arrivals, attachments, steps, mean colours, shared colours and outlines.
constexpr std::array<std::size_t, 5> kFewerFloats{10, 12, 14, 17, 21};
constexpr float kUnseen = std::numeric_limits<float>::quiet_NaN();  // value of an unseen colour
constexpr float kNoMore = 0;                                        // value of former evidence
static_assert(std::endian::native == std::endian::little);

}  // namespace

QByteArray evidenceToBytes(const BorderEvidence& e) {
  const ColorComparison unseen{kUnseen, kUnseen};
  const ColorComparison& colors = e.colors ? *e.colors : unseen;
  const std::array<float, kEvidenceFloats> values{e.observations,
                                                  e.bridged,
                                                  e.shared,
                                                  e.bends,
                                                  e.concavity_rad,
                                                  kNoMore,
                                                  e.folded,
                                                  e.ridged,
                                                  e.color_shift.value_or(kUnseen),
                                                  e.length_m,
                                                  e.appeared_together,
                                                  e.appeared_apart,
                                                  e.attached,
                                                  e.unattached,
                                                  colors.difference,
                                                  colors.chroma_difference,
                                                  e.step_m,
                                                  colors.shared,
                                                  colors.shared_chroma,
                                                  colors.elsewhere,
                                                  colors.variety,
                                                  e.outlined,
                                                  e.unoutlined};
  return {reinterpret_cast<const char*>(values.data()), static_cast<qsizetype>(sizeof(values))};
}

std::optional<BorderEvidence> evidenceFromBytes(const QByteArray& bytes) {
  std::array<float, kEvidenceFloats> values{};
  const ColorComparison usual;  // an older row lacks some or all of these
  values[14] = values[15] = kUnseen;
  values[17] = usual.shared;
  values[18] = usual.shared_chroma;
  values[19] = usual.elsewhere;
  values[20] = usual.variety;
  const auto size = static_cast<std::size_t>(bytes.size());
  const bool is_older = std::ranges::any_of(
      kFewerFloats, [size](std::size_t floats) { return size == floats * sizeof(float); });
  if (size != sizeof(values) && !is_older) return std::nullopt;
  std::memcpy(values.data(), bytes.constData(), size);
  constexpr std::array<std::size_t, 3> kColors{8, 14, 15};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]) && std::ranges::find(kColors, i) == kColors.end()) return std::nullopt;
  }
  BorderEvidence e;
  e.observations = values[0];
  e.bridged = values[1];
  e.shared = values[2];
  e.bends = values[3];
  e.concavity_rad = values[4];
  e.folded = values[6];
  e.ridged = values[7];
  if (std::isfinite(values[8])) e.color_shift = values[8];
  e.length_m = values[9];
  e.appeared_together = values[10];
  e.appeared_apart = values[11];
  e.attached = values[12];
  e.unattached = values[13];
  if (std::isfinite(values[14] + values[15]))
    e.colors = {values[14], values[15], values[17], values[18], values[19], values[20]};
  e.step_m = values[16];
  e.outlined = values[21];
  e.unoutlined = values[22];
  return e;
}

}  // namespace scantrove
