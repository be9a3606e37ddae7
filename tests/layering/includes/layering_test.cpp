#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "tests/layering/includes/layer_rules.h"
#include "tests/support/source_tree.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Layering, SourceTreeFollowsTheRules) {
  const IncludeTree tree = readIncludes(sourceTree());
  ASSERT_GT(tree.size(), 30U) << "the source tree was not found below " << sourceTree();
  for (const std::string& finding : LayerRules::broken(tree)) ADD_FAILURE() << finding;
}

TEST(LayerRules, CoreIncludesNoUiOrApp_AndUiNoApp) {
  EXPECT_THAT(LayerRules::broken({{"core/scan/a.cpp", {"ui/panels/b.h"}}}),
              ElementsAre(HasSubstr("never back")));
  EXPECT_THAT(LayerRules::broken({{"core/base/a.h", {"app/command.h"}}}),
              ElementsAre(HasSubstr("never back")));
  EXPECT_THAT(LayerRules::broken({{"ui/main_window/a.h", {"app/command.h"}}}),
              ElementsAre(HasSubstr("never back")));
  EXPECT_THAT(LayerRules::broken(
                  {{"app/a.cpp", {"ui/panels/b.h", "core/scan/c.h"}}, {"ui/panels/b.h", {"core/scan/c.h"}}}),
              IsEmpty());
}

TEST(LayerRules, ModulesIncludeAllowedModulesOnly) {
  const auto finding = [](const char* file, const char* header) {
    return LayerRules::broken({{file, {header}}});
  };
  EXPECT_THAT(finding("core/base/a.h", "core/compute/b.h"), ElementsAre(HasSubstr("base does not stand on")));
  EXPECT_THAT(finding("core/compute/a.h", "core/capture/intrinsics.h"), ElementsAre(HasSubstr("capture")));
  EXPECT_THAT(finding("core/catalogue/a.h", "core/session/scan_params.h"), ElementsAre(HasSubstr("scan")));
  EXPECT_THAT(finding("core/labeling/kernels/a.cl", "core/tracking/kernels/b.clh"),
              ElementsAre(HasSubstr("labeling does not stand on tracking")));
  EXPECT_THAT(finding("core/pipeline/a.cpp", "core/catalogue/object_record.h"),
              ElementsAre(HasSubstr("pipeline does not stand on catalogue")));
  EXPECT_THAT(finding("core/collection/a.cpp", "core/pipeline/frame_result.h"),
              ElementsAre(HasSubstr("collection does not stand on pipeline")));
  EXPECT_THAT(finding("core/dataset/a.cpp", "core/fusion/brick_map.h"), ElementsAre(HasSubstr("dataset")));
  EXPECT_THAT(finding("core/exchange/a.cpp", "core/dataset/labeled_scan.h"),
              ElementsAre(HasSubstr("exchange")));
  EXPECT_THAT(LayerRules::broken({{"core/scan/a.cpp", {"core/fusion/raycaster.h", "core/catalogue/b.h"}},
                                  {"core/refinement/a.cpp", {"core/pipeline/b.h", "core/session/c.h"}},
                                  {"core/pipeline/a.cpp", {"core/tracking/b.h", "core/base/result.h"}},
                                  {"core/fusion/b.cpp", {"core/compute/buffer.h", "core/base/result.h"}}}),
              IsEmpty());
}

TEST(LayerRules, ReportsAnUnknownModule) {
  EXPECT_THAT(LayerRules::broken({{"core/attic/a.cpp", {"core/base/result.h"}}}),
              ElementsAre(HasSubstr("attic is no module")));
}

TEST(LayerRules, AllowedIncludesHaveNoCycle) {
  const auto& arrows = LayerRules::allowedArrows();
  std::set<std::string> below;
  while (below.size() < arrows.size()) {
    const std::size_t before = below.size();
    for (const auto& [module, targets] : arrows) {
      if (std::ranges::includes(below, targets)) below.insert(module);
    }
    ASSERT_GT(below.size(), before) << "the remaining modules include each other";
  }
}

TEST(LayerRules, CoreUsesNoToolkit_ExceptSqlInTheCatalogue) {
  EXPECT_THAT(LayerRules::broken({{"core/capture/a.cpp", {"QString"}}}),
              ElementsAre(HasSubstr("core knows no Qt")));
  EXPECT_THAT(LayerRules::broken({{"core/catalogue/a.cpp", {"QImage"}}}),
              ElementsAre(HasSubstr("core knows no Qt")));
  EXPECT_THAT(LayerRules::broken({{"core/catalogue/a.cpp", {"QtWidgets/QLabel"}}}),
              ElementsAre(HasSubstr("no Qt")));
  EXPECT_THAT(LayerRules::broken({{"core/scan/a.cpp", {"vtkSmartPointer.h"}}}),
              ElementsAre(HasSubstr("no VTK")));
  EXPECT_THAT(LayerRules::broken({{"core/catalogue/a.cpp", {"QSqlDatabase", "QByteArray", "QtCore/QFile"}}}),
              IsEmpty());
}

TEST(LayerRules, QtAndVtkAreSeparate) {
  EXPECT_THAT(LayerRules::broken({{"ui/scene/a.cpp", {"QColor"}}}),
              testing::Contains(HasSubstr("without Qt")));
  EXPECT_THAT(LayerRules::broken({{"ui/panels/a.cpp", {"vtkActor.h"}}}),
              testing::Contains(HasSubstr("only ui/scene and ui/view")));
  EXPECT_THAT(LayerRules::broken({{"ui/panels/a.cpp", {"QLabel"}}, {"ui/scene/b.cpp", {"vtkActor.h"}}}),
              IsEmpty());
}

TEST(LayerRules, QtAndVtkAreSeparate_InIndirectIncludes) {
  const IncludeTree tree{{"ui/panels/a.cpp", {"ui/scene/b.h"}}, {"ui/scene/b.h", {"vtkActor.h"}}};
  EXPECT_THAT(LayerRules::broken(tree), ElementsAre(HasSubstr("ui/panels/a.cpp reaches vtkActor.h")));
  const IncludeTree other{{"ui/scene/a.cpp", {"ui/theme/b.h"}}, {"ui/theme/b.h", {"QPalette"}}};
  EXPECT_THAT(LayerRules::broken(other), ElementsAre(HasSubstr("ui/scene/a.cpp reaches QPalette")));
}

TEST(LayerRules, OnlyOneFileUsesQtAndVtk) {
  IncludeTree tree{{"ui/view/a.cpp", {"QOpenGLWidget", "vtkActor.h"}},
                   {"ui/view/a.h", {"QOpenGLWidget", "vtkNew.h"}}};
  EXPECT_THAT(LayerRules::broken(tree), IsEmpty());
  tree["ui/view/b.cpp"] = {"QLabel", "vtkActor.h"};
  EXPECT_THAT(LayerRules::broken(tree), ElementsAre(HasSubstr("more than one file: ui/view/a ui/view/b")));
}

TEST(LayerRules, ReadsIncludesOfRealFiles) {
  const TemporaryFolder folder;
  folder.write("core/base/a.h",
               "#pragma once\n  #  include \"core/compute/b.h\"\n#include <vector>\n// #include \"x\"\n");
  folder.write("core/base/notes.txt", "#include \"core/scan/c.h\"\n");
  const IncludeTree tree = readIncludes(folder.path());
  ASSERT_EQ(tree.size(), 1U);
  EXPECT_THAT(tree.at("core/base/a.h"), ElementsAre("core/compute/b.h", "vector"));
  EXPECT_EQ(LayerRules::broken(tree).size(), 1U);
}

}  // namespace
}  // namespace scantrove::test
