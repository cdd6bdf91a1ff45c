#include "holomorphic/poles.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/surfaces.h"
#include "support/vessel_surfaces.h"
#include "surface/check.h"
#include "surface/generate.h"

namespace hexwall::test {
namespace {

struct Vessel {
  explicit Vessel(const TriangleSurface& input)
      : surface(check_surface(input).surface),
        mesh(connectivity_of(surface)),
        edge(Eigen::VectorXd::Ones(mesh.face_count())) {}
  FormProblem problem() const { return {surface, mesh, edge}; }
  PoleResult with_poles(const PoleOptions& options = {}) const {
    return place_poles(problem(), solve_form(problem()), options);
  }

  TriangleSurface surface;
  Connectivity mesh;
  Eigen::VectorXd edge;
};

void expect_poly_annulus(const FormSolution& s) {
  const int loops = static_cast<int>(s.connectivity.loops().size());
  EXPECT_EQ(s.connectivity.euler_number(), 2 - loops);
  EXPECT_EQ(s.basis.size(), loops - 1);
  EXPECT_NEAR(s.form.periods.sum(), 0.0, 1e-9 * s.form.periods.cwiseAbs().maxCoeff());
  EXPECT_EQ(s.refined.negative_edges, 0);
}

TEST(Poles, ComeInABlindSac) {
  const Vessel vessel(tube_with_sac());
  const PoleResult r = vessel.with_poles();
  ASSERT_GE(r.poles.size(), 1U);
  EXPECT_LE(r.poles.size(), 2U);
  EXPECT_GT(r.poles[0].disk.center.position.x(), 2.0) << "not in the sac";
  EXPECT_LT(r.poles[0].off_share_after, 0.5 * r.poles[0].off_share_before);
  expect_poly_annulus(r.solution);
  EXPECT_EQ(r.solution.connectivity.loops().size(), 2 + r.poles.size());
  EXPECT_TRUE(r.solution.is_pole(2));
  EXPECT_FALSE(r.solution.is_pole(1));
}

// With so many loops a place is judged by the loops near it.
TEST(Poles, ComeInABlindSacAmongManyLoops) {
  const Vessel vessel(tree_with_sides(30, true));
  const FormSolution start = solve_form(vessel.problem());
  ASSERT_EQ(start.basis.size(), 31);
  PoleOptions options;
  options.most = 1;
  options.only_if_worthwhile = false;
  const PoleResult r = place_poles(vessel.problem(), start, options);
  ASSERT_EQ(r.poles.size(), 1U);
  const Vec3& place = r.poles[0].disk.center.position;
  EXPECT_GT(std::hypot(place.x(), place.y()), 4.0) << "not in the sac";
  EXPECT_GT(place.z(), 37.0) << "not in the sac";
  EXPECT_LT(r.poles[0].off_share_after, 0.6 * r.poles[0].off_share_before);
  expect_poly_annulus(r.solution);
}

TEST(Poles, AreReportedWithWhatTheyBring) {
  const Vessel vessel(tube_with_sac());
  const FormSolution before = solve_form(vessel.problem());
  const PoleResult r = vessel.with_poles();
  ASSERT_FALSE(r.poles.empty());
  double energy = before.optimum.energy;
  double off = before.off_size_share;
  for (const PoleStep& pole : r.poles) {
    EXPECT_EQ(pole.energy_before, energy);
    EXPECT_EQ(pole.off_share_before, off);
    EXPECT_LE(pole.energy_after, (1.0 - PoleOptions{}.least_gain) * energy);
    energy = pole.energy_after;
    off = pole.off_share_after;
  }
  EXPECT_EQ(r.solution.optimum.energy, energy);
  EXPECT_EQ(r.solution.off_size_share, off);
}

TEST(Poles, AreNotPlacedWhereNothingIsBlind) {
  for (const Shape shape : {Shape::cylinder, Shape::bifurcation, Shape::aaa}) {
    EXPECT_TRUE(Vessel(generate_shape(shape)).with_poles().poles.empty());
  }
}

TEST(Poles, AreAsManyAsAskedFor) {
  const Vessel vessel(generate_shape(Shape::bifurcation));
  PoleOptions options;
  options.only_if_worthwhile = false;
  for (const int count : {0, 1, 2}) {
    options.most = count;
    const PoleResult r = vessel.with_poles(options);
    EXPECT_EQ(static_cast<int>(r.poles.size()), count);
    expect_poly_annulus(r.solution);
  }
}

// The best form of a straight tube is even: the best charge in it is none.
TEST(Poles, DoNotComeIfTheyWouldVanish) {
  const Vessel vessel(cylinder(1.0, 3.0, 8, 4));
  PoleOptions options;
  options.most = 1;
  options.only_if_worthwhile = false;
  EXPECT_TRUE(vessel.with_poles(options).poles.empty());
  expect_error(ExitCode::usage, {"no room for a pole at (1, 0, 1.5)", "vanish"}, [&] {
    place_poles_at(vessel.problem(), solve_form(vessel.problem()), {{1.0, 0.0, 1.5}});
  });
}

TEST(Poles, GoWhereTheyAreAskedFor) {
  const Vessel vessel(tube_with_sac());
  const Vec3 place(4.0, 0.1, 5.2);
  const PoleResult r = place_poles_at(vessel.problem(), solve_form(vessel.problem()), {place});
  ASSERT_EQ(r.poles.size(), 1U);
  double nearest = 1e300;
  for (const Vec3& p : vessel.surface.points) nearest = std::min(nearest, (p - place).norm());
  EXPECT_LE((r.poles[0].disk.center.position - place).norm(), nearest);
}

TEST(Poles, DoNotFitBesideOneAnother) {
  const Vessel vessel(tube_with_sac());
  const Vec3 place(4.5, 0.0, 5.0);
  expect_error(ExitCode::usage, {"no room for a pole at (4.5, 0, 5)"}, [&] {
    place_poles_at(vessel.problem(), solve_form(vessel.problem()), std::vector<Vec3>(40, place));
  });
}

/// The judgement of a candidate is what it says: where two places are mirror images, so are the
/// energies; and the form does not depend on the unit.
TEST(Poles, DoNotDependOnTheUnit) {
  const TriangleSurface small = tube_with_sac();
  TriangleSurface large = small;
  for (Vec3& p : large.points) p *= 1024.0;  // exact
  const PoleResult a = Vessel(small).with_poles();
  const PoleResult b = Vessel(large).with_poles();
  ASSERT_EQ(a.poles.size(), b.poles.size());
  for (std::size_t i = 0; i < a.poles.size(); ++i) {
    EXPECT_NEAR(a.poles[i].energy_after, b.poles[i].energy_after, 1e-6);
    EXPECT_NEAR(1024.0 * a.poles[i].disk.radius, b.poles[i].disk.radius,
                1e-5 * b.poles[i].disk.radius);
  }
}

}  // namespace
}  // namespace hexwall::test
