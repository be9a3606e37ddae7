#pragma once
#include <string>

#include "core/synthetic/placed_part.h"

namespace scantrove::synthetic {

// Furniture. Each but the wall adds one instance and returns its id.
/// A wall 2.5 m high that lets light through.
void addWall(SyntheticScene& scene, const std::string& name, const Place& place, double length,
             std::uint32_t color);
/// A table's foot is the floor; `size` is length (x), depth (y) and height.
std::uint16_t addTable(SyntheticScene& scene, const Place& place, const Vec3& size, const Material& material);
/// Seat front towards -y of the chair's own frame; seat at 0.45 m, back up to 0.88 m.
std::uint16_t addChair(SyntheticScene& scene, const std::string& name, const Place& place,
                       const Material& frame, const Material& cushion);
std::uint16_t addStool(SyntheticScene& scene, const std::string& name, const Place& place,
                       const Material& material);
/// Open shelves, open towards -y.
std::uint16_t addShelf(SyntheticScene& scene, const std::string& name, const Place& place, const Vec3& size,
                       const Material& material);
std::uint16_t addBasket(SyntheticScene& scene, const std::string& name, const Place& place,
                        const Material& material);

}  // namespace scantrove::synthetic
