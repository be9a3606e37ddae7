#pragma once
#include <QString>
#include <span>
#include <string>

namespace scantrove {

/// Fixed words of core in the window's language: stages of a frame, units and explanations of parameters.
/// Core has no Qt, so they are listed here for the translation. Other texts, such as error messages, are
/// returned as they are, in English.
[[nodiscard]] QString coreText(const std::string& text);

/// The listed words.
[[nodiscard]] std::span<const char* const> translatedCoreTexts();

}  // namespace scantrove
