// Every failure of the program: its exit code, its message, and that nothing is written.

#include <string>

#include <gtest/gtest.h>

#include "program/program_fails.h"
#include "support/bad_surfaces.h"
#include "support/capped.h"

namespace hexwall::test {
namespace {

// --- exit code 2: the command line --------------------------------------------------------------

TEST_F(ProgramFails, WithoutACommand) {
  expect_failure(2, {"subcommand"}, {});
}

TEST_F(ProgramFails, OnAnUnknownCommand) {
  expect_failure(2, {}, {"paint"});
}

TEST_F(ProgramFails, OnAnUnknownOption) {
  expect_usage_error({"--frobnicate"}, {"--frobnicate"});
}

TEST_F(ProgramFails, WithoutASurface) {
  expect_failure(2, {"SURFACE"}, {"mesh", "-o", output_});
}

TEST_F(ProgramFails, WithoutAnOutput) {
  expect_failure(2, {"--output"}, {"mesh", surface_});
}

TEST_F(ProgramFails, OnLengthsThatAreNotPositive) {
  for (const char* option : {"--size", "--thickness"}) {
    for (const char* value : {"0", "-1", "nan", "inf"}) {
      SCOPED_TRACE(std::string(option) + " " + value);
      expect_usage_error({option}, {option, value});
    }
    expect_usage_error({option}, {option, "thick"});
  }
}

TEST_F(ProgramFails, OnLayersBelowOne) {
  expect_usage_error({"--layers"}, {"--layers", "0"});
  expect_usage_error({"--layers"}, {"--layers", "-3"});
  expect_usage_error({"--layers"}, {"--layers", "1.5"});
}

TEST_F(ProgramFails, OnGrowthThatIsNotPositive) {
  expect_usage_error({"--growth"}, {"--growth", "-1"});
  expect_usage_error({"--growth"}, {"--growth", "0"});
}

TEST_F(ProgramFails, OnRelaxOutOfRange) {
  expect_usage_error({"--relax"}, {"--relax", "2"});
  expect_usage_error({"--relax"}, {"--relax", "-0.1"});
}

TEST_F(ProgramFails, OnAnUnknownUnit) {
  expect_usage_error({"furlong"}, {"--units", "furlong"});
}

TEST_F(ProgramFails, OnAnUnknownFormat) {
  expect_usage_error({"foo"}, {"--write", "foo"});
  expect_usage_error({"foo"}, {"--write", "vtu,foo"});
}

TEST_F(ProgramFails, OnThreadsBelowOne) {
  expect_usage_error({"--threads"}, {"--threads", "0"});
  expect_usage_error({"--threads"}, {"--threads", "many"});
}

TEST_F(ProgramFails, OnQuietTogetherWithVerbose) {
  expect_usage_error({"--quiet"}, {"--quiet", "--verbose"});
}

TEST_F(ProgramFails, OnAnUnknownShape) {
  expect_failure(2, {"dragon", "bifurcation"}, {"generate", "dragon", "-o", output_ + ".stl"});
}

TEST_F(ProgramFails, OnBadEdgeLengthsOfShapes) {
  for (const char* edge : {"0", "-1", "100", "1e-9"}) {
    expect_failure(2, {"edge length"},
                   {"generate", "cylinder", "--edge", edge, "-o", output_ + ".stl"});
  }
}

// --- exit code 3: reading -----------------------------------------------------------------------

TEST_F(ProgramFails, OnAMissingFile) {
  expect_failure(3, {"missing.stl"}, {"mesh", (folder_ / "missing.stl").string(), "-o", output_});
}

TEST_F(ProgramFails, OnAFolderInPlaceOfAFile) {
  expect_failure(3, {folder_.path().filename().string()},
                 {"mesh", folder_.path().string(), "-o", output_});
}

TEST_F(ProgramFails, OnAnEmptyFile) {
  expect_unreadable("empty.stl", "", "empty");
}

TEST_F(ProgramFails, OnATruncatedFile) {
  const std::string bytes = bytes_of(surface_);
  expect_unreadable("half.stl", bytes.substr(0, bytes.size() / 2), "");
}

TEST_F(ProgramFails, OnEmptyAndTruncatedFilesOfAllFormats) {
  for (const char* extension : {".stl", ".ply", ".off", ".vtp", ".vtk"}) {
    const std::string whole = (folder_ / ("whole" + std::string(extension))).string();
    write_surface(whole, cylinder(1.0, 3.0, 16, 6));
    const std::string bytes = bytes_of(whole);
    expect_unreadable("half" + std::string(extension), bytes.substr(0, bytes.size() / 2), "");
    expect_unreadable("empty" + std::string(extension), "", "");
  }
  expect_unreadable("empty.obj", "", "");
}

TEST_F(ProgramFails, OnAnUnknownExtension) {
  expect_unreadable("surface.step", "ISO-10303-21;", ".stl");
}

// --- exit code 4: topology ----------------------------------------------------------------------

TEST_F(ProgramFails, OnAClosedSurface) {
  expect_refused(4, {"closed"}, closed_surface());
}

TEST_F(ProgramFails, OnTwoComponents) {
  expect_refused(4, {"2 ", "near ("}, two_tubes());
}

TEST_F(ProgramFails, OnASingleLoop) {
  expect_refused(4, {"loop"}, one_loop());
}

TEST_F(ProgramFails, OnASingleOpeningAfterOpening) {
  // One end is a flat cap and is opened, the other one is round.
  TriangleSurface surface = capped(cylinder(1.0, 3.0, 16, 6), CapStyle::wheel);
  surface.points.back().z() += surface.points.back().z() > 1.0 ? 0.7 : -0.7;
  expect_refused(4, {"only one boundary loop"}, surface);
}

TEST_F(ProgramFails, OnAMobiusBand) {
  expect_refused(4, {"Moebius", "near ("}, mobius_band());
}

TEST_F(ProgramFails, OnAnEdgeWithThreeTriangles) {
  expect_refused(4, {"more than two triangles", "near ("}, tube_with_fin(), {"--no-repair"});
}

TEST_F(ProgramFails, OnAHandle) {
  expect_refused(4, {"genus 1", "near ("}, torus_with_holes());
}

// --- exit code 5: geometry ----------------------------------------------------------------------

TEST_F(ProgramFails, OnCoordinatesThatAreNoNumbers) {
  expect_refused(5, {"finite", "vertex 48"}, not_a_number());
}

TEST_F(ProgramFails, OnSelfIntersections) {
  expect_refused(5, {"intersect", "near ("}, self_intersecting());
}

TEST_F(ProgramFails, OnTrianglesWithoutArea) {
  expect_refused(5, {"area", "near ("}, zero_area(), {"--no-repair"});
}

// --- exit code 6: meshing -----------------------------------------------------------------------

TEST_F(ProgramFails, OnAWallThatDoesNotFit) {
  const std::string path = (folder_ / "bifurcation.vtp").string();
  write_surface(path, generate_shape(Shape::bifurcation, 0.3));
  expect_failure(6, {"hexwall: error: ", "no wall"},
                 {"mesh", path, "-o", output_, "--size", "0.3", "--thickness", "1e9"});
}

// --- exit code 7: writing -----------------------------------------------------------------------

TEST_F(ProgramFails, OnAnOutputFolderBelowAFile) {
  expect_failure(7, {"hexwall: error: ", "tube.stl/out"},
                 {"mesh", surface_, "-o", surface_ + "/out"});
}

TEST_F(ProgramFails, OnAnOutputFolderThatIsAFile) {
  expect_failure(7, {"hexwall: error: ", "tube.stl"}, {"mesh", surface_, "-o", surface_});
}

TEST_F(ProgramFails, OnAShapeInAMissingFolder) {
  expect_failure(7, {"nowhere"},
                 {"generate", "cylinder", "-o", (folder_ / "nowhere/cylinder.stl").string()});
}

TEST_F(ProgramFails, OnAShapeOfUnknownFormat) {
  expect_failure(7, {".step", ".stl"},
                 {"generate", "cylinder", "-o", (folder_ / "cylinder.step").string()});
}

/// The files of an earlier run survive a run that fails.
TEST_F(ProgramFails, KeepingTheResultsOfAnEarlierRun) {
  const ChildResult first = run_hexwall({"mesh", surface_, "-o", output_, "--size", "0.4"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const std::string path = (folder_ / "bad.vtp").string();
  write_surface(path, two_tubes());
  expect_failure(4, {}, {"mesh", path, "-o", output_});
}

}  // namespace
}  // namespace hexwall::test
