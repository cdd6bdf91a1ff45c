// How much is computed, counted: it grows as theory says, and does not creep up.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "holomorphic/solution.h"
#include "support/vessel_surfaces.h"

namespace hexwall::test {
namespace {

FormSolution solution_on_aaa(double edge) {
  const TriangleSurface surface = generate_shape(Shape::aaa, edge);
  const Connectivity mesh = connectivity_of(surface);
  return solve_form({surface, mesh, Eigen::VectorXd::Ones(mesh.face_count())});
}

// Nested dissection of planar meshes leaves O(#V log #V) entries in the factor (Lipton, Rose and
// Tarjan 1979); orderings by minimum degree come near to that.
TEST(Work, OfFactorsGrowsHardlyFasterThanTheSurface) {
  const auto per_vertex = [](double edge) {
    const FormSolution s = solution_on_aaa(edge);
    const auto vertices = static_cast<double>(s.connectivity.vertex_count());
    return static_cast<double>(s.factor_nonzeros) / (vertices * std::log2(vertices));
  };
  const double coarse = per_vertex(2.0);
  const double fine = per_vertex(1.0);
  EXPECT_LT(fine, 1.25 * coarse);
}

// Newton's method: a descent from lengths of the loops takes few steps, whatever the signs.
TEST(Work, OfDescentsIsFewSteps) {
  const FormSolution s = solution_on_aaa(2.0);
  ASSERT_EQ(s.optimum.descents.size(), 511U);
  std::size_t steps = 0;
  std::size_t most = 0;
  for (const Descent& descent : s.optimum.descents) {
    steps += descent.iterations.size() - 1;
    most = std::max(most, descent.iterations.size() - 1);
  }
  EXPECT_LE(steps, 11U * 511U);
  EXPECT_LE(most, 25U);
}

}  // namespace
}  // namespace hexwall::test
