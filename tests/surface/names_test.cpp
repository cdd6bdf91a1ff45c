#include "surface/names.h"

#include <fstream>
#include <optional>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/surfaces.h"
#include "support/temporary_folder.h"
#include "surface/generate.h"
#include "surface/units.h"

namespace hexwall {
namespace {

std::optional<std::string> warning_of(const TriangleSurface& surface, double metres_per_unit) {
  return unit_warning(surface, connectivity_of(surface), metres_per_unit);
}

using test::expect_error;

std::vector<NamedPlace> read_text(const std::string& content) {
  const TemporaryFolder folder;
  std::ofstream(folder / "names.json") << content;
  return read_names(folder / "names.json");
}

void expect_refused(const std::string& content, std::initializer_list<const char*> words) {
  expect_error(ExitCode::read, words, [&] { read_text(content); });
}

const std::vector<Vec3> centers{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}};
const std::vector<double> radii{1.0, 1.0, 0.5};

TEST(Names, AreReadWithTheirPlaces) {
  const auto places = read_text(
      R"([{"name": "inlet", "at": [1, 2.5, -3e1]}, {"name": "A-1.b", "at": [0, 0, 0], "x": 1}])");
  ASSERT_EQ(places.size(), 2U);
  EXPECT_EQ(places[0].name, "inlet");
  EXPECT_EQ(places[0].at, Vec3(1, 2.5, -30));
  EXPECT_EQ(places[1].name, "A-1.b");
}

TEST(Names, RefuseFilesThatAreNotOfTheForm) {
  expect_error(ExitCode::read, {"/nowhere/n.json", "opened"},
               [] { read_names("/nowhere/n.json"); });
  expect_refused("[{]", {"names.json", "parse error"});
  expect_refused(R"({"inlet": [0, 0, 0]})", {"list"});
  expect_refused(R"(["inlet"])", {"entry 1", "\"name\""});
  expect_refused(R"([{"name": "a", "at": [0, 0, 0]}, {"at": [0, 0, 0]}])", {"entry 2"});
  expect_refused(R"([{"name": 5, "at": [0, 0, 0]}])", {"entry 1"});
  expect_refused(R"([{"name": "a", "at": [0, 0]}])", {"three numbers"});
  expect_refused(R"([{"name": "a", "at": [0, 0, "0"]}])", {"three numbers"});
}

TEST(Names, RefuseWhatIsNoPatchName) {
  for (const char* name :
       {"", "my inlet", "1st", "a/b", "a;b", "$a", "-a", "inner_wall", "outer_wall", "wall", "core",
        "lumen", "interface", "left_wall", "\\u00e4"}) {
    expect_refused(std::string(R"([{"at": [0, 0, 0], "name": ")") + name + "\"}]",
                   {"entry 1", "cannot be the name of a patch"});
  }
  expect_refused(R"([{"name": "a", "at": [0, 0, 0]}, {"name": "a", "at": [1, 0, 0]}])",
                 {"entry 2", "'a' occurs twice"});
}

TEST(Names, AreMadeValidWhereTheyComeFromArrays) {
  EXPECT_EQ(valid_name("ModelFaceID_2"), "ModelFaceID_2");
  EXPECT_EQ(valid_name("my lids_1e+06"), "my_lids_1e_06");
  EXPECT_EQ(valid_name("2"), "_2");
  EXPECT_EQ(valid_name("inner_wall"), "inner_wall_");
  EXPECT_EQ(valid_name(""), "_");
}

TEST(Names, GoToTheNearestOpening) {
  EXPECT_EQ(assign_names(centers, radii, {}),
            (std::vector<std::string>{"loop_0", "loop_1", "loop_2"}));
  EXPECT_EQ(assign_names(centers, radii, {{"top", {0, 9, 0}}, {"in", {0.1, 0, 1}}}),
            (std::vector<std::string>{"in", "loop_1", "top"}));
}

TEST(Names, RefusePlacesThatAreAmbiguous) {
  expect_error(ExitCode::usage, {"'a'", "'b'", "same opening"}, [] {
    assign_names(centers, radii, {{"a", {0, 0, 0}}, {"b", {1, 0, 0}}});
  });
  expect_error(ExitCode::usage, {"no opening is near 'a'", "(0, 10, 0)"}, [] {
    assign_names(centers, radii, {{"a", {0, 8, 0}}});  // 4 radii from the third
  });
  expect_error(ExitCode::usage, {"no opening is near 'a'"}, [] {
    assign_names({}, {}, {{"a", {0, 0, 0}}});
  });
  expect_error(ExitCode::usage, {"'loop_0'", "two openings"}, [] {
    assign_names(centers, radii, {{"loop_0", {10, 0, 0}}});
  });
}

// --- units --------------------------------------------------------------------------------------

TEST(UnitWarning, NamesTheUnitThatFits) {
  const TriangleSurface tube = cylinder(0.01, 0.2, 24, 60);  // 1 cm and 20 cm in metres
  EXPECT_FALSE(warning_of(tube, 1.0));
  const auto warning = warning_of(tube, 1e-3);
  ASSERT_TRUE(warning);
  EXPECT_NE(warning->find("0.202 mm across"), std::string::npos) << *warning;
  EXPECT_NE(warning->find("it would be one in m"), std::string::npos) << *warning;
  EXPECT_EQ(warning->find("mm or"), std::string::npos);
}

TEST(UnitWarning, LooksAtTheRadiusToo) {
  // 1 m long with a radius of 0.3 m would fit into a body, but is no vessel ...
  const auto warning = warning_of(cylinder(0.3, 1.0, 24, 12), 1.0);
  ASSERT_TRUE(warning);
  EXPECT_NE(warning->find("one in mm or cm"), std::string::npos) << *warning;
  // ... and a tube 100,000 times as long as wide is one in no unit.
  const auto hair = warning_of(cylinder(1e-3, 100.0, 8, 100), 1.0);
  ASSERT_TRUE(hair);
  EXPECT_NE(hair->find("none of"), std::string::npos) << *hair;
}

TEST(UnitWarning, TakesFlatSurfacesByTheirDiagonal) {
  EXPECT_FALSE(warning_of(annulus(1.0, 2.0, 24, 4), 1e-3));
  EXPECT_TRUE(warning_of(annulus(1.0, 2.0, 24, 4), 1.0));
}

class Units : public testing::TestWithParam<std::string> {};

TEST_P(Units, OfRealVesselsAreTold) {
  const auto surface = test::load_surface(GetParam());
  if (!surface) GTEST_SKIP() << "there is no file of " << GetParam();
  const bool is_in_metres =
      GetParam() == "palabos_aneurysm_open.stl" || GetParam() == "openlb_bifurcation3d.vtp";
  const auto in_mm = warning_of(*surface, 1e-3);
  const auto in_m = warning_of(*surface, 1.0);
  EXPECT_EQ(in_mm.has_value(), is_in_metres);
  EXPECT_EQ(in_m.has_value(), !is_in_metres);
  const std::string warning = is_in_metres ? *in_mm : *in_m;
  EXPECT_NE(warning.find(is_in_metres ? "one in m" : "one in mm"), std::string::npos) << warning;
}

INSTANTIATE_TEST_SUITE_P(UnitWarning, Units,
                         testing::Values("aneurysm", "palabos_aneurysm_open.stl",
                                         "vmtk4an_ideal_aneurysm.stl", "vampy_case71_remeshed.vtp",
                                         "vampy_left_atrium.vtp", "vasp_stenosis_tube.vtp",
                                         "openlb_bifurcation3d.vtp", "carotid_jk_left.vtp"),
                         test::test_name);

}  // namespace
}  // namespace hexwall
