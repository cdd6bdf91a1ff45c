// Walls that were hard to come by, of those that tests/bench/wall_matrix.sh makes, and lumens: each
// meshed by the program and judged by OpenFOAM.

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/check_mesh.h"
#include "support/child_process.h"
#include "support/result_files.h"
#include "support/surfaces.h"
#include "support/temporary_folder.h"

namespace hexwall::test {
namespace {

namespace fs = std::filesystem;

struct Wall {
  const char* trouble;
  const char* surface;
  const char* ratio;  ///< of the thickness to the radius
  const char* layers;
  const char* side;
};

void PrintTo(const Wall& wall, std::ostream* out) {
  *out << wall.trouble << ": " << wall.surface;
}

class HardWall : public testing::TestWithParam<Wall> {};

TEST_P(HardWall, IsGoodEnough) {
  const Wall& wall = GetParam();
  const TemporaryFolder folder;
  const auto file = surface_file(wall.surface, folder.path().string());
  if (!file) GTEST_SKIP() << wall.surface << " is not on this machine";
  const fs::path output = folder / "out";
  std::vector<std::string> arguments{
      "mesh",     *file,      "-o",        output.string(), "--thickness-ratio",
      wall.ratio, "--layers", wall.layers, "--side",        wall.side};
  if (std::string(wall.side) == "both") {
    for (const char* argument :
         {"--inner-thickness-ratio", wall.ratio, "--inner-layers", wall.layers}) {
      arguments.emplace_back(argument);
    }
  }
  const ChildResult result = run_hexwall(arguments);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  if (std::string(wall.side) != "both") expect_valid_results(output);
  EXPECT_GE(report_in(output)["wall"]["min_scaled_jacobian"], 0.2);
  const CheckMeshResult checked = check_mesh(output / "openfoam", "");
  if (!checked.available) GTEST_SKIP() << "checkMesh is not installed";
  EXPECT_TRUE(checked.ok) << checked.log;
}

INSTANTIATE_TEST_SUITE_P(
    , HardWall,
    testing::Values(Wall{"obliquely_cut_opening", "vampy_left_atrium.vtp", "0.1", "8", "out"},
                    Wall{"skewed_end_ring", "vampy_left_atrium.vtp", "0.2", "8", "in"},
                    Wall{"evening_out_folds", "vmtk4an_ideal_aneurysm.stl", "0.2", "1", "out"},
                    Wall{"face_tets_cost_jacobian", "vascularmd_cerebral_stenosis_quads.vtk", "0.2",
                         "8", "both"},
                    Wall{"polishing_closes_quads_up", "vampy_left_atrium_C35_flowext.vtp", "0.2",
                         "1", "out"}),
    [](const auto& test) { return std::string(test.param.trouble); });

struct Lumen {
  const char* trouble;
  const char* surface;
};

void PrintTo(const Lumen& lumen, std::ostream* out) {
  *out << lumen.trouble << ": " << lumen.surface;
}

class HardLumen : public testing::TestWithParam<Lumen> {};

TEST_P(HardLumen, PassesAllChecks) {
  const Lumen& lumen = GetParam();
  const TemporaryFolder folder;
  const auto file = surface_file(lumen.surface, folder.path().string());
  if (!file) GTEST_SKIP() << lumen.surface << " is not on this machine";
  const fs::path output = folder / "out";
  const ChildResult result = run_hexwall({"lumen", *file, "-o", output.string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto region = report_in(output)["lumen"]["regions"][0];
  EXPECT_LT(region["non_orthogonality_deg"]["worst"], 70.0);
  EXPECT_LT(region["skewness"]["worst"], 4.0);
  const CheckMeshResult checked = check_mesh(output / "openfoam");
  if (!checked.available) GTEST_SKIP() << "checkMesh is not installed";
  EXPECT_TRUE(checked.ok) << checked.log;
}

INSTANTIATE_TEST_SUITE_P(, HardLumen,
                         testing::Values(Lumen{"apex_far_from_where_a_quad_can_be_split",
                                               "openlb_bifurcation3d_closed.stl"},
                                         Lumen{"steep_faces_in_a_stenosis",
                                               "vascularmd_cerebral_stenosis_quads.vtk"},
                                         Lumen{"thinner_layers_lack_face_tets", "aaa"}),
                         [](const auto& test) { return std::string(test.param.trouble); });

}  // namespace
}  // namespace hexwall::test
