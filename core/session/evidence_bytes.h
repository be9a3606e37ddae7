#pragma once
#include <QByteArray>
#include <optional>

#include "core/session/saved_scan.h"

namespace scantrove {

/// Border evidence without its constraint, as the table `borders` keeps it: 21 floats.
[[nodiscard]] QByteArray evidenceToBytes(const BorderEvidence& evidence);
/// Of earlier versions with fewer numbers, too. None: it was not written so.
[[nodiscard]] std::optional<BorderEvidence> evidenceFromBytes(const QByteArray& bytes);

}  // namespace scantrove
