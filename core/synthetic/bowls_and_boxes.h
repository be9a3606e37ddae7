#pragma once
#include <string>

#include "core/synthetic/placed_part.h"

namespace scantrove::synthetic {

// Small things, 5 - 40 cm. Each adds one object instance of the given name and returns its id.
std::uint16_t addMug(SyntheticScene& scene, const std::string& name, const Place& place,
                     const Material& material);
std::uint16_t addTeapot(SyntheticScene& scene, const std::string& name, const Place& place,
                        const Material& material);
std::uint16_t addBowl(SyntheticScene& scene, const std::string& name, const Place& place,
                      const Material& material);
std::uint16_t addVase(SyntheticScene& scene, const std::string& name, const Place& place,
                      const Material& material);
std::uint16_t addCan(SyntheticScene& scene, const std::string& name, const Place& place,
                     const Material& material);
std::uint16_t addBottle(SyntheticScene& scene, const std::string& name, const Place& place,
                        const Material& material);
std::uint16_t addBall(SyntheticScene& scene, const std::string& name, const Place& place, double radius,
                      const Material& material);
std::uint16_t addRing(SyntheticScene& scene, const std::string& name, const Place& place,
                      const Material& material);
std::uint16_t addArch(SyntheticScene& scene, const std::string& name, const Place& place,
                      const Material& material);
std::uint16_t addCarton(SyntheticScene& scene, const std::string& name, const Place& place, const Vec3& size,
                        const Material& material);
/// `size`: spine to fore edge, height, thickness. Upright books stand on their lower edge, spine towards -y.
std::uint16_t addBook(SyntheticScene& scene, const std::string& name, const Place& place, const Vec3& size,
                      const Material& material, bool upright = false);
/// Two slabs at a right angle: the foot lies along x, the upright stands at its -x end.
std::uint16_t addLBlock(SyntheticScene& scene, const std::string& name, const Place& place, const Vec3& size,
                        double thickness, double radius, const Material& material);
std::uint16_t addCactus(SyntheticScene& scene, const std::string& name, const Place& place);
std::uint16_t addLamp(SyntheticScene& scene, const std::string& name, const Place& place,
                      const Material& shade);

}  // namespace scantrove::synthetic
