// OpenFOAM's checkMesh on the walls of generated and real vessels, written by the program itself.

#include "support/check_mesh.h"

#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/child_process.h"
#include "support/surfaces.h"
#include "support/temporary_folder.h"

namespace hexwall::test {
namespace {

struct Case {
  const char* surface;
  const char* size = "";  ///< empty: the default
  const char* layers = "3";
  const char* known_flaw = "";  ///< what checkMesh still finds, and why; empty: nothing
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.surface << ' ' << c.size;
}

class Cases : public testing::TestWithParam<Case> {};

TEST_P(Cases, PassCheckMesh) {
  const TemporaryFolder folder;
  const auto file = surface_file(GetParam().surface, folder.path().string());
  if (!file) GTEST_SKIP() << GetParam().surface << " is not on this machine";
  const std::string output = (folder / "out").string();
  std::vector<std::string> arguments{"mesh",    *file,      "-o",       output,
                                     "--write", "openfoam", "--layers", GetParam().layers};
  if (*GetParam().size != '\0') arguments.insert(arguments.end(), {"--size", GetParam().size});
  const ChildResult meshed = run_hexwall(arguments);
  ASSERT_EQ(meshed.exit_code, 0) << meshed.err;
  const CheckMeshResult checked = check_mesh(folder / "out/openfoam");
  if (!checked.available) GTEST_SKIP() << "checkMesh is not installed";
  if (*GetParam().known_flaw == '\0') {
    EXPECT_TRUE(checked.ok) << checked.log;
    return;
  }
  EXPECT_FALSE(checked.ok) << "the flaw is mended: take it out of the table";
  if (!checked.ok) GTEST_SKIP() << "known: " << GetParam().known_flaw;
}

INSTANTIATE_TEST_SUITE_P(
    , Cases,
    testing::Values(
        Case{"cylinder"}, Case{"bifurcation"}, Case{"aaa", "0.86"}, Case{"aneurysm", "0.8", "2"},
        Case{"palabos_aneurysm_open.stl"},
        Case{"vmtk4an_ideal_aneurysm.stl", "", "3", "quads too large in the sac"},
        Case{"vampy_ica_artery_C0015.vtp"}, Case{"vampy_case71_remeshed.vtp"},
        Case{"vampy_artery_test_small.stl"}, Case{"vampy_vein_test_small.stl"},
        Case{"vampy_left_atrium.vtp"},
        Case{"vampy_left_atrium_C35_flowext.vtp", "", "3", "quads too large in the appendage"},
        Case{"vampy_left_atrium_moving.vtp", "", "3", "skewness 4.5 where the wall is reduced"},
        Case{"vasp_artery_flowext.vtp"}, Case{"vasp_stenosis_tube.vtp"}, Case{"vasp_cylinder.vtp"},
        Case{"vascularmd_cerebral_stenosis_quads.vtk"}, Case{"vascularmd_ideal_quads.vtk"},
        Case{"openlb_bifurcation3d.vtp"}, Case{"carotid_jk_left.vtp"}),
    [](const auto& test) {
      return test_name({test.param.surface, test.index});
    });

}  // namespace
}  // namespace hexwall::test
