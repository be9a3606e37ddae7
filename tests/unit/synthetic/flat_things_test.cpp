#include "core/synthetic/flat_things.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace scantrove::synthetic {
namespace {

TEST(FlatThings, AreObjectsLowerThan15Millimetres) {
  std::set<std::string> names;
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    HashStream random(seed);
    const Thing thing = makeRandomFlatThing(random);
    EXPECT_TRUE(thing.who.is_object) << thing.who.name;
    EXPECT_LT(thing.height(), 0.015) << thing.who.name;
    EXPECT_NEAR(reachOf(thing.parts, Vec3::UnitZ()), thing.height(), 1e-9) << thing.who.name;
    EXPECT_NEAR(reachOf(thing.parts, -Vec3::UnitZ()), 0, 1e-9) << thing.who.name << " stands on z = 0";
    names.insert(thing.who.name);
  }
  for (const char* name :
       {"paper", "magazine", "book", "knife", "fork", "spoon", "pen", "keyboard", "plate", "phone", "napkin"})
    EXPECT_TRUE(names.contains(name)) << name;
}

TEST(FlatThings, CarryOthers_WhenStackable) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    HashStream random(seed);
    const Thing thing = makeFlatStackable(random);
    ASSERT_EQ(thing.stands.size(), 1U) << thing.who.name;
    EXPECT_NEAR(thing.stands.front().z, thing.height(), 1e-9);
  }
}

}  // namespace
}  // namespace scantrove::synthetic
