// `hexwall check`: its words, its JSON, its files and its exit codes.

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include "program/program_fails.h"
#include "support/bad_surfaces.h"
#include "support/capped.h"
#include "support/faults.h"

namespace hexwall::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Verdict {
  const char* name;
  TriangleSurface (*surface)();
  int code;
  const char* kind;   ///< of the problem
  const char* words;  ///< of the refusal
};

void PrintTo(const Verdict& verdict, std::ostream* out) {
  *out << verdict.name;
}

vtkSmartPointer<vtkPolyData> read_vtp(const fs::path& path) {
  const vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// How many points `problems.vtp` has of a kind.
int places_of(vtkPolyData* problems, const std::string& kind) {
  auto* names =
      vtkStringArray::SafeDownCast(problems->GetFieldData()->GetAbstractArray("kind_names"));
  auto* kinds = problems->GetCellData()->GetArray("kind");
  int count = 0;
  for (vtkIdType i = 0; i < problems->GetNumberOfCells(); ++i) {
    if (names->GetValue(static_cast<vtkIdType>(kinds->GetComponent(i, 0))) == kind) ++count;
  }
  return count;
}

class Check : public ProgramFails {
 protected:
  std::string file_of(const TriangleSurface& surface) const {
    std::string path = (folder_ / "vessel.vtp").string();
    write_surface(path, surface);
    return path;
  }

  void expect_said(const ChildResult& result, int code, const std::vector<std::string>& words) {
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_EQ(result.err, "");
    for (const std::string& word : words) {
      EXPECT_NE(result.out.find(word), std::string::npos) << word << " in: " << result.out;
    }
  }
};

TEST_F(Check, FindsNothingWrongWithASoundSurface) {
  const auto before = files();
  expect_said(
      run_hexwall({"check", surface_}), 0,
      {"read       112 vertices, 192 triangles", "none as it comes", "opening    loop_0 at (0, 0, ",
       "can be meshed: 112 vertices, 192 triangles, 2 openings"});
  EXPECT_EQ(files(), before);
}

TEST_F(Check, SaysWhatIsRepaired) {
  const std::string file = file_of(geometry_faults().back().surface);
  const ChildResult result = run_hexwall({"check", file, "-o", output_, "--units", "cm"});
  expect_said(result, 0,
              {"problem    the surface has a self-intersection", "done       the surface crossed",
               "moved      by repairs: ", " cm at most", "can be meshed"});
  const auto problems = read_vtp(fs::path(output_) / "problems.vtp");
  EXPECT_GT(places_of(problems, "self_intersections"), 0);
  EXPECT_GT(places_of(problems, "repair_intersections"), 0);
  const auto prepared = read_vtp(fs::path(output_) / "prepared.vtp");
  EXPECT_EQ(prepared->GetNumberOfPolys(), 2 * 48 * 24);
}

TEST_F(Check, SaysWhatWasDoneBeforeARefusal) {
  TriangleSurface surface = capped(cylinder(1.0, 3.0, 16, 6), CapStyle::fan);
  append(surface, torus_with_holes(), {9, 0, 0});
  surface.triangles.erase(surface.triangles.begin(), surface.triangles.begin() + 2 * 16 * 6 + 14);
  const std::string file = file_of(surface);
  expect_said(run_hexwall({"check", file}), 4,
              {"problem    the surface has 2 connected components",
               "done       1 small component, of 14 triangles, was dropped",
               "refused: the surface has genus 1"});
}

TEST_F(Check, PrintsTheJsonThatItWrites) {
  const ChildResult result = run_hexwall({"check", surface_, "--json", "-o", output_});
  expect_said(result, 0, {});
  EXPECT_EQ(result.out, bytes_of(fs::path(output_) / "check.json"));
  const json checked = json::parse(result.out);
  EXPECT_EQ(checked["input"]["vertices"], 112);
  EXPECT_EQ(checked["input"]["faces"], 192);
  EXPECT_EQ(checked["meshable"], true);
  EXPECT_EQ(checked["exit_code"], 0);
  EXPECT_TRUE(checked["problems"].empty());
  EXPECT_TRUE(checked["warnings"].empty());
  ASSERT_EQ(checked["openings"].size(), 2U);
  EXPECT_EQ(checked["openings"][0]["name"], "loop_0");
  EXPECT_EQ(checked["openings"][0]["center"].size(), 3U);
}

TEST_F(Check, MarksExtensionsOfThePreparedSurface) {
  expect_said(run_hexwall({"check", surface_, "-o", output_, "--extend", "3"}), 0,
              {"loop_0: extended the opening", "loop_1: extended the opening"});
  const auto prepared = read_vtp(fs::path(output_) / "prepared.vtp");
  auto* extension = prepared->GetCellData()->GetArray("extension");
  ASSERT_NE(extension, nullptr);
  EXPECT_EQ(extension->GetRange()[0], -1.0);
  EXPECT_EQ(extension->GetRange()[1], 1.0);
}

TEST_F(Check, FailsAsMeshingDoes) {
  expect_failure(3, {"missing.stl"}, {"check", "missing.stl", "-o", output_});
  expect_failure(2, {"--extend"}, {"check", surface_, "-o", output_, "--extend", "-1"});
  expect_failure(2, {"SURFACE"}, {"check"});
  expect_failure(7, {"tube.stl"}, {"check", surface_, "-o", surface_});
}

class CheckRefuses : public Check, public testing::WithParamInterface<Verdict> {};

TEST_P(CheckRefuses, WithReasonAndPlace) {
  const Verdict& expected = GetParam();
  const std::string file = file_of(expected.surface());
  const ChildResult result = run_hexwall({"check", file, "--no-repair", "-o", output_});
  expect_said(result, expected.code, {"verdict    refused: ", expected.words});
  const json checked = json::parse(bytes_of(fs::path(output_) / "check.json"));
  EXPECT_EQ(checked["meshable"], false);
  EXPECT_EQ(checked["exit_code"], expected.code);
  EXPECT_NE(checked["reason"].get<std::string>().find(expected.words), std::string::npos);
  EXPECT_EQ(checked["problems"][0]["kind"], expected.kind);
  EXPECT_FALSE(fs::exists(fs::path(output_) / "prepared.vtp"));
  // A closed surface is closed everywhere, and what is not finite is nowhere.
  if (expected.surface == closed_surface || expected.surface == not_a_number) return;
  EXPECT_GT(places_of(read_vtp(fs::path(output_) / "problems.vtp"), expected.kind), 0);
}

INSTANTIATE_TEST_SUITE_P(
    , CheckRefuses,
    testing::Values(Verdict{"closed", closed_surface, 4, "closed", "the surface is closed"},
                    Verdict{"two_tubes", two_tubes, 4, "components", "2 connected components"},
                    Verdict{"one_loop", one_loop, 4, "closed", "only one boundary loop"},
                    Verdict{"mobius_band", mobius_band, 4, "not_orientable", "Moebius band"},
                    Verdict{"fin", tube_with_fin, 4, "nonmanifold_edges",
                            "more than two triangles"},
                    Verdict{"handle", torus_with_holes, 4, "genus", "genus 1"},
                    Verdict{"not_a_number", not_a_number, 5, "not_finite", "not finite"},
                    Verdict{"self_intersecting", self_intersecting, 5, "self_intersections",
                            "self-intersection"},
                    Verdict{"zero_area", zero_area, 5, "degenerate", "area"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace hexwall::test
