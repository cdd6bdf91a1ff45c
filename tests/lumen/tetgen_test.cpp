#include "lumen/tetgen.h"

#include <csignal>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <thread>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "core/forked.h"

namespace hexwall {
namespace {

void add_box(const Vec3& low, const Vec3& high, bool inside_out, TriangleSurface& surface) {
  const auto first = static_cast<int>(surface.points.size());
  for (int i = 0; i < 8; ++i) {
    surface.points.emplace_back((i & 1) != 0 ? high.x() : low.x(),
                                (i & 2) != 0 ? high.y() : low.y(),
                                (i & 4) != 0 ? high.z() : low.z());
  }
  for (auto [a, b, c, d] : std::vector<std::array<int, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    if (inside_out) std::swap(b, d);
    surface.triangles.push_back({first + a, first + b, first + c});
    surface.triangles.push_back({first + a, first + c, first + d});
  }
}

TriangleSurface box(const Vec3& low, const Vec3& high) {
  TriangleSurface surface;
  add_box(low, high, false, surface);
  return surface;
}

/// A box from the origin to `high` whose sides are grids of n x n squares, each two triangles.
TriangleSurface grid_box(const Vec3& high, int n) {
  TriangleSurface surface;
  std::map<std::array<int, 3>, int> known;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [place, is_new] = known.try_emplace(at, static_cast<int>(surface.points.size()));
    if (is_new) {
      surface.points.emplace_back(high.x() * at[0] / n, high.y() * at[1] / n, high.z() * at[2] / n);
    }
    return place->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {0, n}) {
      for (int i = 0; i < n * n; ++i) {
        const auto corner = [&](int u, int v) {
          std::array<int, 3> at{};
          at[axis] = side;
          at[(axis + 1) % 3] = i % n + u;
          at[(axis + 2) % 3] = i / n + v;
          return vertex(at);
        };
        const int a = corner(0, 0);
        const int c = corner(1, 1);
        const int b = side == n ? corner(1, 0) : corner(0, 1);
        const int d = side == n ? corner(0, 1) : corner(1, 0);
        surface.triangles.push_back({a, b, c});
        surface.triangles.push_back({a, c, d});
      }
    }
  }
  return surface;
}

double volume(const TetMesh& mesh, const std::array<int, 4>& t) {
  const auto& p = mesh.points;
  return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).dot(p[t[3]] - p[t[0]]) / 6.0;
}

TetMesh fill(const TriangleSurface& surface, double edge, const TetOptions& options = {}) {
  return fill_with_tets(surface, std::vector<double>(surface.points.size(), edge), options);
}

TEST(Tetrahedra, FillASurfaceWithoutNewPointsOnIt) {
  const TriangleSurface surface = grid_box({1, 2, 3}, 6);
  const TetMesh mesh = fill(surface, 0.3);
  double sum = 0.0;
  for (const auto& t : mesh.tets) {
    EXPECT_GT(volume(mesh, t), 0.0);
    sum += volume(mesh, t);
  }
  EXPECT_NEAR(sum, 6.0, 1e-12);
  ASSERT_GT(mesh.points.size(), surface.points.size());
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Vec3& p = mesh.points[v];
    if (v < surface.points.size()) {
      EXPECT_EQ(p, surface.points[v]);
    } else {
      EXPECT_GT((p - Vec3(0, 0, 0)).minCoeff(), 1e-9);
      EXPECT_GT((Vec3(1, 2, 3) - p).minCoeff(), 1e-9);
    }
  }
}

TEST(Tetrahedra, AreAsLargeAsAskedAndGrowInwards) {
  const TriangleSurface surface = grid_box({4, 4, 4}, 8);
  const TetMesh even = fill(surface, 0.5);
  const double regular = 0.5 * 0.5 * 0.5 / (6.0 * std::sqrt(2.0));
  const double mean = 64.0 / static_cast<double>(even.tets.size());
  EXPECT_GT(mean, 0.4 * regular);
  EXPECT_LT(mean, 1.6 * regular);
  TetOptions growing;
  growing.growth = 0.5;
  EXPECT_LT(fill(surface, 0.5, growing).tets.size(), even.tets.size() / 2);
}

TEST(Tetrahedra, ASurfaceThatMeetsItselfIsRefusedWithThePlace) {
  TriangleSurface surface = box({0, 0, 0}, {1, 1, 1});
  add_box({0.5, 0.5, 0.5}, {2, 2, 2}, false, surface);
  try {
    fill(surface, 0.3);
    FAIL() << "nothing was thrown";
  } catch (const GeometryError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("meets itself"), std::string::npos) << what;
    EXPECT_NE(what.find('('), std::string::npos) << what;
  }
}

// Sheets closer than TetGen's tolerance do not meet for CGAL, but TetGen gives up or crashes. An
// error, or all of the volume: nothing else.
TEST(Tetrahedra, SheetsCloserThanTetGensToleranceAreNoCrash) {
  TriangleSurface surface = box({0, 0, 0}, {1, 1, 1});
  add_box({0.3, 0.3, 1e-11}, {0.7, 0.7, 0.5}, true, surface);
  try {
    const TetMesh mesh = fill(surface, 0.3);
    double sum = 0.0;
    for (const auto& t : mesh.tets) sum += volume(mesh, t);
    EXPECT_NEAR(sum, 1.0, 1e-6);
  } catch (const MeshingError& error) {
    EXPECT_NE(std::string(error.what()).find("comes closest to itself at ("), std::string::npos)
        << error.what();
  }
}

TEST(Tetrahedra, TetGenIsEndedWhenItsTimeIsUp) {
  TetOptions hurried;
  hurried.seconds = 0.02;
  try {
    fill(grid_box({1, 1, 1}, 20), 0.02, hurried);
    FAIL() << "nothing was thrown";
  } catch (const MeshingError& error) {
    EXPECT_NE(std::string(error.what()).find("took longer"), std::string::npos) << error.what();
  }
}

TEST(Forked, HandsBackBytesOfAnySize) {
  const ForkedResult run = run_forked([] { return std::string(3000000, 'x'); }, 60.0);
  EXPECT_TRUE(run.finished);
  EXPECT_EQ(run.bytes, std::string(3000000, 'x'));
}

TEST(Forked, SurvivesACrashAndKeepsWhatWasSaid) {
  const ForkedResult run = run_forked(
      []() -> std::string {
        std::fputs("about to abort", stderr);
        std::abort();
      },
      60.0);
  EXPECT_FALSE(run.finished);
  EXPECT_EQ(run.signal, SIGABRT);
  EXPECT_EQ(run.output, "about to abort");
}

TEST(Forked, AnExceptionIsNoResult) {
  const ForkedResult run =
      run_forked([]() -> std::string { throw std::runtime_error("no"); }, 60.0);
  EXPECT_FALSE(run.finished);
  EXPECT_EQ(run.output, "no");
}

TEST(Forked, EndsWhatTakesTooLong) {
  const ForkedResult run = run_forked(
      []() -> std::string {
        for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
      },
      0.05);
  EXPECT_TRUE(run.timed_out);
  EXPECT_FALSE(run.finished);
}

}  // namespace
}  // namespace hexwall
