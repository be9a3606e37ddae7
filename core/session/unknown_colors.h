#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// Grey.
inline constexpr std::array<std::uint8_t, 3> kUnknownColor{128, 128, 128};

/// Gives vertices of unknown colour, such as backs that depth readings of oblique surface made, the colour of
/// the surface around them, and grey where there is none nearby. A mesh without any colour stays as it is.
/// `is_known`: for each vertex.
void fillUnknownColors(LabeledMesh& mesh, std::vector<bool> is_known);

}  // namespace scantrove
