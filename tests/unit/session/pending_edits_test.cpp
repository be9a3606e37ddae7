#include "core/session/pending_edits.h"

#include <gmock/gmock.h>

namespace scantrove {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Kind = CatalogueStep::Kind;

constexpr RegionId kNamed{3};

class PendingEditsTest : public testing::Test {
 protected:
  [[nodiscard]] std::vector<CatalogueStep> stepsOf(const Operation& operation,
                                                   EditDirection direction) const {
    return catalogueStepsOf(operation, direction, [this](RegionId) -> const RegionNote& { return note_; });
  }
  RegionNote note_;
};

TEST_F(PendingEditsTest, StepsOfANamingHaveItsClass) {
  const Operation naming{.regions = {kNamed}, .name = "red mug", .category = "mug"};
  EXPECT_THAT(stepsOf(naming, EditDirection::done),
              ElementsAre(CatalogueStep{Kind::name, kNamed, "red mug", "mug"}));
  EXPECT_THAT(stepsOf(naming, EditDirection::redone),
              ElementsAre(CatalogueStep{Kind::redo_name, kNamed, "red mug", "mug"}));
  EXPECT_THAT(stepsOf(naming, EditDirection::undone),
              ElementsAre(CatalogueStep{Kind::revert_name, kNamed, "red mug"}));
}

TEST_F(PendingEditsTest, UndoneRemovalGivesNameAndClassAgain) {
  note_.name = "red mug";
  note_.category = "mug";
  EXPECT_THAT(stepsOf({.regions = {kNamed}}, EditDirection::undone),
              ElementsAre(CatalogueStep{Kind::name, kNamed, "red mug", "mug"}));
}

TEST_F(PendingEditsTest, ReadBackEqual_FromText) {
  const std::vector<PendingEdit> edits{
      {"a1", {{Kind::name, kNamed, "red mug", "mug"}, {Kind::revert_name, kNamed, "cup"}}},
      {"b2", {{Kind::add, kNamed}}}};
  EXPECT_EQ(pendingEditsFromJson(pendingEditsToJson(edits)), edits);
  const char* of_an_older_version =
      R"([{"token": "a1", "steps": [{"do": "name", "region": 3, "name": "mug"}]}])";
  EXPECT_THAT(pendingEditsFromJson(of_an_older_version),
              ElementsAre(PendingEdit{"a1", {{Kind::name, kNamed, "mug"}}}));
  EXPECT_THAT(pendingEditsFromJson("[{"), IsEmpty());
}

}  // namespace
}  // namespace scantrove
