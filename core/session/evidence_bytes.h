#pragma once
#include <QByteArray>
#include <optional>

#include "core/session/saved_scan.h"

namespace scantrove {

/// Border evidence without its constraint, as in the table `borders`: 23 floats.
[[nodiscard]] QByteArray evidenceToBytes(const BorderEvidence& evidence);
/// Also reads earlier versions with fewer numbers. None: malformed.
[[nodiscard]] std::optional<BorderEvidence> evidenceFromBytes(const QByteArray& bytes);

}  // namespace scantrove
