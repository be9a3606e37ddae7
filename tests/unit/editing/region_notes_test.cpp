#include "core/editing/region_notes.h"

#include <gtest/gtest.h>

#include <string>

namespace scantrove {
namespace {

RegionNote after(OperationKind kind, bool on, const RegionNote& before) {
  Operation operation;
  operation.kind = kind;
  operation.on = on;
  return notedBy(operation, before);
}

Operation namingAs(const std::string& name, const std::string& category) {
  Operation operation;
  operation.name = name;
  operation.category = category;
  return operation;
}

TEST(RegionNotes, ANamedRegionIsAnObject) {
  const RegionNote before{.name = "mug", .category = "cup", .background = true, .rejected = true};
  EXPECT_EQ(notedBy(namingAs("bowl", "dish"), before), (RegionNote{.name = "bowl", .category = "dish"}));
  EXPECT_EQ(notedBy(namingAs("", ""), before), (RegionNote{.background = true})) << "the name is removed";
  EXPECT_EQ(userLabelOf({.name = "bowl"}), UserLabel::object);
}

TEST(RegionNotes, MarksAreSetAndTakenBack) {
  EXPECT_EQ(after(OperationKind::background, true, {}), (RegionNote{.background = true}));
  EXPECT_EQ(after(OperationKind::background, false, {.background = true}), RegionNote{});
  EXPECT_EQ(after(OperationKind::object, true, {.background = true, .rejected = true}),
            (RegionNote{.object = true}));
  EXPECT_EQ(after(OperationKind::object, false, {.object = true}), (RegionNote{.rejected = true}));
  EXPECT_EQ(after(OperationKind::reject, true, {.object = true}), (RegionNote{.rejected = true}));
  EXPECT_EQ(after(OperationKind::reject, false, {.rejected = true}), RegionNote{});
}

TEST(RegionNotes, OtherOperationsChangeNoNote) {
  const RegionNote note{.name = "mug", .background = true};
  for (const OperationKind kind :
       {OperationKind::join, OperationKind::cut, OperationKind::finer, OperationKind::coarser,
        OperationKind::paint, OperationKind::unpaint, OperationKind::review})
    EXPECT_EQ(after(kind, true, note), note) << toString(kind);
}

TEST(RegionNotes, AJoinCompletesTheNote_UnlessOneIsBackground) {
  const RegionNote mug{.name = "mug", .category = "cup"};
  EXPECT_EQ(joinedNote({}, mug), mug);
  EXPECT_EQ(joinedNote({.object = true}, mug),
            (RegionNote{.name = "mug", .category = "cup", .object = true}));
  EXPECT_EQ(joinedNote({.name = "bowl"}, mug), (RegionNote{.name = "bowl", .category = "cup"}));
  EXPECT_EQ(joinedNote({.name = "bowl", .category = "dish"}, mug),
            (RegionNote{.name = "bowl", .category = "dish"}));
  EXPECT_EQ(joinedNote({.background = true}, mug), (RegionNote{.background = true}));
  EXPECT_EQ(joinedNote({.object = true}, {.name = "table", .background = true}),
            (RegionNote{.object = true}));
}

TEST(RegionNotes, TheMappingLearnsWhatTheNoteSays) {
  EXPECT_EQ(userLabelOf({}), UserLabel::nothing);
  EXPECT_EQ(userLabelOf({.category = "cup"}), UserLabel::nothing);
  EXPECT_EQ(userLabelOf({.object = true}), UserLabel::object);
  EXPECT_EQ(userLabelOf({.background = true}), UserLabel::background);
  EXPECT_EQ(userLabelOf({.rejected = true}), UserLabel::background);
}

}  // namespace
}  // namespace scantrove
