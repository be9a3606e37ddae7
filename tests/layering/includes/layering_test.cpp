#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/layering/includes/layer_rules.h"
#include "tests/support/source_tree.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Layering, TheHouseKeepsItsRules) {
  const IncludeTree tree = readIncludes(sourceTree());
  ASSERT_GT(tree.size(), 30U) << "the source tree was not found below " << sourceTree();
  for (const std::string& finding : LayerRules::broken(tree)) ADD_FAILURE() << finding;
}

TEST(LayerRules, CoreNeverLooksUp) {
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

TEST(LayerRules, ModulesStandInTheirOrder) {
  EXPECT_THAT(LayerRules::broken({{"core/base/a.h", {"core/compute/b.h"}}}),
              ElementsAre(HasSubstr("stands on nothing")));
  EXPECT_THAT(LayerRules::broken({{"core/compute/a.h", {"core/capture/intrinsics.h"}}}),
              ElementsAre(HasSubstr("base alone")));
  EXPECT_THAT(LayerRules::broken({{"core/catalogue/a.h", {"core/scan/scan_params.h"}}}),
              ElementsAre(HasSubstr("no module knows scan")));
  EXPECT_THAT(
      LayerRules::broken({{"core/scan/a.cpp", {"core/fusion/raycaster.h", "core/catalogue/detector.h"}},
                          {"core/fusion/b.cpp", {"core/compute/buffer.h", "core/base/result.h"}}}),
      IsEmpty());
}

TEST(LayerRules, CollectionKnowsNoPipeline) {
  EXPECT_THAT(LayerRules::broken({{"core/collection/a.cpp",
                                   {"core/catalogue/catalogue_mirror.h", "core/discovery/candidate_finder.h",
                                    "core/fusion/depth_view.h", "core/base/result.h"}}}),
              IsEmpty());
  for (const char* header : {"core/scan/scan_pipeline.h", "core/tracking/pose_tracker.h"})
    EXPECT_EQ(LayerRules::broken({{"core/collection/a.cpp", {header}}}).size(), 1U) << header;
}

TEST(LayerRules, ImagesAreReadByAllAndKnowNobody) {
  EXPECT_THAT(LayerRules::broken({{"core/catalogue/a.cpp", {"core/image/png_decoder.h"}}}), IsEmpty());
  EXPECT_THAT(LayerRules::broken({{"core/image/a.cpp", {"core/capture/intrinsics.h"}}}),
              ElementsAre(HasSubstr("image stands on base alone")));
}

TEST(LayerRules, GeometryIsUsedByAllAndStandsOnBase) {
  EXPECT_THAT(LayerRules::broken({{"core/labeling/a.cpp", {"core/geometry/surface_step.h"}}}), IsEmpty());
  EXPECT_THAT(LayerRules::broken({{"core/geometry/a.h", {"core/capture/intrinsics.h"}}}),
              ElementsAre(HasSubstr("geometry stands on base alone")));
}

TEST(LayerRules, DataSetsAreMadeOfWhatCameFromFilesAlone) {
  EXPECT_THAT(LayerRules::broken({{"core/dataset/a.cpp",
                                   {"core/capture/pose_files.h", "core/exchange/atomic_file.h",
                                    "core/image/png_decoder.h", "core/base/result.h"}},
                                  {"core/scan/b.cpp", {"core/dataset/labelled_scan.h"}}}),
              IsEmpty());
  for (const char* header :
       {"core/fusion/brick_map.h", "core/fusion/rendered_view.h", "core/discovery/candidate.h"}) {
    EXPECT_THAT(LayerRules::broken({{"core/dataset/a.cpp", {header}}}),
                ElementsAre(HasSubstr("exchange alone")));
  }
  EXPECT_THAT(LayerRules::broken({{"core/dataset/a.cpp", {"core/scan/scan_params.h"}}}),
              ElementsAre(HasSubstr("no module knows scan")));
  EXPECT_THAT(LayerRules::broken({{"core/exchange/a.cpp", {"core/dataset/labelled_scan.h"}}}),
              ElementsAre(HasSubstr("above exchange")));
}

TEST(LayerRules, ModulesKnowPlainDataOnly) {
  EXPECT_THAT(LayerRules::broken({{"core/labeling/a.cpp", {"core/fusion/raycaster.h"}}}),
              ElementsAre(HasSubstr("not each other's machinery")));
  EXPECT_THAT(LayerRules::broken({{"core/labeling/kernels/a.cl", {"core/segmentation/kernels/b.clh"}}}),
              ElementsAre(HasSubstr("not each other's machinery")));
  EXPECT_THAT(LayerRules::broken(
                  {{"core/labeling/a.cpp", {"core/fusion/surface_maps.h", "core/fusion/fusion_params.h"}},
                   {"core/labeling/kernels/a.cl", {"core/fusion/kernels/brick_lookup.clh"}}}),
              IsEmpty());
}

TEST(LayerRules, CoreHasNoToolkitButSqlInTheCatalogue) {
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

TEST(LayerRules, QtAndVtkStayApart) {
  EXPECT_THAT(LayerRules::broken({{"ui/scene/a.cpp", {"QColor"}}}),
              testing::Contains(HasSubstr("without Qt")));
  EXPECT_THAT(LayerRules::broken({{"ui/panels/a.cpp", {"vtkActor.h"}}}),
              testing::Contains(HasSubstr("only ui/scene and ui/view")));
  EXPECT_THAT(LayerRules::broken({{"ui/panels/a.cpp", {"QLabel"}}, {"ui/scene/b.cpp", {"vtkActor.h"}}}),
              IsEmpty());
}

TEST(LayerRules, NorDoTheyMeetThroughTheBackDoor) {
  const IncludeTree tree{{"ui/panels/a.cpp", {"ui/scene/b.h"}}, {"ui/scene/b.h", {"vtkActor.h"}}};
  EXPECT_THAT(LayerRules::broken(tree), ElementsAre(HasSubstr("ui/panels/a.cpp reaches vtkActor.h")));
  const IncludeTree other{{"ui/scene/a.cpp", {"ui/theme/b.h"}}, {"ui/theme/b.h", {"QPalette"}}};
  EXPECT_THAT(LayerRules::broken(other), ElementsAre(HasSubstr("ui/scene/a.cpp reaches QPalette")));
}

TEST(LayerRules, OneFileIsWhereTheyMeet) {
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
