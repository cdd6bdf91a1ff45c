// OpenFOAM's measures: by hand, and against checkMesh itself.

#include <cmath>
#include <numbers>
#include <regex>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "exporters/openfoam.h"
#include "inspect/read_mesh.h"
#include "inspect/small_meshes.h"
#include "support/block_mesh.h"
#include "support/check_mesh.h"
#include "support/temporary_folder.h"

namespace hexwall::test {
namespace {

constexpr double eps = 1e-12;

TEST(FoamMetrics, OfAGridOfCubes) {
  const MeshQuality q = mesh_quality(bricks(3, 3, 3, [](const Vec3& p) { return p; }));
  EXPECT_EQ(foam(q, "nonOrthoAngle").count, 54U);  // faces between the cubes
  EXPECT_EQ(foam(q, "skewness").count, 108U);      // all faces
  EXPECT_NEAR(foam(q, "nonOrthoAngle").max, 0.0, 1e-6);
  EXPECT_NEAR(foam(q, "skewness").max, 0.0, eps);
  EXPECT_NEAR(foam(q, "faceWeight").min, 0.5, eps);
  EXPECT_NEAR(foam(q, "cellVolumeRatio").min, 1.0, eps);
  EXPECT_NEAR(foam(q, "faceFlatness").min, 1.0, eps);
  EXPECT_NEAR(foam(q, "aspectRatio").max, 1.0, eps);
  EXPECT_NEAR(foam(q, "cellOpenness").max, 0.0, eps);
  EXPECT_NEAR(foam(q, "cellVolume").min, 1.0, eps);
  EXPECT_NEAR(foam(q, "minPyrVolume").min, 1.0 / 6.0, eps);
  EXPECT_NEAR(foam(q, "faceTetVolume").min, 1.0 / 24.0, eps);
  EXPECT_NEAR(foam(q, "cellDeterminant").max, 1.0, eps);        // the middle one
  EXPECT_NEAR(foam(q, "cellDeterminant").min, 1.0 / 8.0, eps);  // those at the corners
}

// Layers of height 1 and 3, sheared by 30 degrees: d leans by 30 degrees from the face's normal.
TEST(FoamMetrics, OfLeaningLayers) {
  const double lean = std::tan(std::numbers::pi / 6.0);
  const MeshQuality q = mesh_quality(bricks(1, 1, 2, [&](const Vec3& p) {
    const double z = p.z() == 2.0 ? 4.0 : p.z();
    return Vec3(p.x() + lean * z, p.y(), z);
  }));
  EXPECT_NEAR(foam(q, "nonOrthoAngle").max, 30.0, 1e-9);
  EXPECT_NEAR(foam(q, "nonOrthoAngle").mean, 30.0, 1e-9);
  EXPECT_NEAR(foam(q, "faceWeight").min, 0.25, eps);
  EXPECT_NEAR(foam(q, "cellVolumeRatio").min, 1.0 / 3.0, eps);
  EXPECT_EQ(foam(q, "cellDeterminant").max, 0.0);  // one internal face spans no space
  EXPECT_EQ(foam(q, "cellDeterminant").beyond.size(), 2U);
}

TEST(FoamMetrics, FindsWhatIsWrong) {
  const MeshQuality q = mesh_quality(bricks(1, 1, 2, [](const Vec3& p) {
    return p.z() == 2.0 ? Vec3(p.x(), p.y(), 0.5) : p;  // the second cube is turned inside out
  }));
  EXPECT_EQ(foam(q, "cellVolume").beyond, std::vector<int>{1});
  EXPECT_LT(foam(q, "cellVolume").min, 0.0);
  EXPECT_FALSE(foam(q, "minPyrVolume").beyond.empty());
  EXPECT_FALSE(foam(q, "faceTetVolume").beyond.empty());
}

/// Numbers of checkMesh's log.
class Log {
 public:
  explicit Log(std::string text) : text_(std::move(text)) {}

  /// The number behind the words; fails the test if they are not there.
  double after(const std::string& words) const {
    std::smatch match;
    const std::regex pattern(words + R"(\s*([-+.eE0-9]+))");
    const bool found = std::regex_search(text_, match, pattern);
    EXPECT_TRUE(found) << words << " in: " << text_;
    return found ? std::stod(match[1]) : 0.0;
  }

 private:
  std::string text_;
};

void expect_close(double ours, double theirs) {
  EXPECT_NEAR(ours, theirs, 2e-5 * std::abs(theirs) + 1e-15);  // six digits are printed
}

TEST(FoamMetrics, AgreeWithCheckMesh) {
  BlockTube tube;
  tube.around = 7;
  tube.layers = 3;
  HexMesh mesh = block_mesh(tube);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const double s = static_cast<double>(i);
    mesh.points[i] += 0.07 * Vec3(std::sin(7.1 * s), std::sin(3.3 * s), std::sin(5.7 * s));
  }
  const TemporaryFolder folder;
  write_openfoam(folder.path(), mesh, 1.0);
  const CheckMeshResult check = check_mesh(folder.path());
  if (!check.available) GTEST_SKIP() << "checkMesh is not installed";
  const Log log(check.log);
  const MeshQuality q = mesh_quality(read_mesh(folder.path()));
  EXPECT_EQ(q.count[static_cast<std::size_t>(ElementShape::hexahedron)], mesh.shape.size());
  expect_close(foam(q, "nonOrthoAngle").max, log.after("non-orthogonality Max:"));
  expect_close(foam(q, "nonOrthoAngle").mean, log.after("non-orthogonality Max: [^ ]+ average:"));
  expect_close(foam(q, "skewness").max, log.after("Max skewness ="));
  expect_close(foam(q, "aspectRatio").max, log.after("Max aspect ratio ="));
  expect_close(foam(q, "cellVolume").min, log.after("Min volume ="));
  expect_close(foam(q, "faceFlatness").min, log.after("butterfly\\) : min ="));
  expect_close(foam(q, "faceFlatness").mean, log.after("butterfly\\) : min = [^ ]+  average ="));
  expect_close(foam(q, "cellDeterminant").min, log.after("wellposedness\\) : minimum:"));
  expect_close(foam(q, "cellDeterminant").mean,
               log.after("wellposedness\\) : minimum: [^ ]+ average:"));
  expect_close(foam(q, "faceWeight").min, log.after("interpolation weight : minimum:"));
  expect_close(foam(q, "cellVolumeRatio").min, log.after("volume ratio : minimum:"));
  // This mesh is bad on purpose.
  EXPECT_EQ(foam(q, "faceTetVolume").beyond.size(),
            log.after("<<Writing (?=[0-9]+ faces with low quality)"));
  EXPECT_EQ(foam(q, "cellDeterminant").beyond.size(),
            log.after("<<Writing (?=[0-9]+ under-determined)"));
}

}  // namespace
}  // namespace hexwall::test
