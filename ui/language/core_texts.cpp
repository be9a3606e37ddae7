#include "ui/language/core_texts.h"

#include <QCoreApplication>
#include <array>

namespace scantrove {
namespace {

constexpr std::array kCoreTexts{
    // stages of a frame (ScanSnapshot::stage_times)
    QT_TRANSLATE_NOOP("Core", "track"),
    QT_TRANSLATE_NOOP("Core", "filter"),
    QT_TRANSLATE_NOOP("Core", "integrate"),
    QT_TRANSLATE_NOOP("Core", "raycast"),
    QT_TRANSLATE_NOOP("Core", "color"),
    QT_TRANSLATE_NOOP("Core", "segment"),
    QT_TRANSLATE_NOOP("Core", "support"),
    QT_TRANSLATE_NOOP("Core", "project"),
    QT_TRANSLATE_NOOP("Core", "merge"),
    QT_TRANSLATE_NOOP("Core", "update"),
    QT_TRANSLATE_NOOP("Core", "discover"),
    QT_TRANSLATE_NOOP("Core", "detect"),
    // units and explanations of the parameters that the window shows (paramRegistry)
    QT_TRANSLATE_NOOP("Core", "m"),
    QT_TRANSLATE_NOOP("Core", "frames"),
    QT_TRANSLATE_NOOP("Core", "above 0: fragments join more readily (log-odds)"),
    QT_TRANSLATE_NOOP("Core", "minimum object size, longest side"),
    QT_TRANSLATE_NOOP("Core", "maximum object size, longest side"),
    QT_TRANSLATE_NOOP("Core", "frames with a stable size before a region becomes a candidate"),
    QT_TRANSLATE_NOOP("Core", "below: recognised (0 = same picture, 2 = unrelated)"),
    QT_TRANSLATE_NOOP("Core", "side of a voxel of the map (auto: by the footprint of a depth pixel)"),
    QT_TRANSLATE_NOOP("Core", "farther readings are ignored (auto: 5 m, more in halls)"),
};

}  // namespace

QString coreText(const std::string& text) { return QCoreApplication::translate("Core", text.c_str()); }

std::span<const char* const> translatedCoreTexts() { return kCoreTexts; }

}  // namespace scantrove
