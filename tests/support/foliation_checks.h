#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "foliation/foliation.h"
#include "foliation/labels.h"
#include "support/harmonic_forms.h"

namespace hexwall::test {

/// A surface, a form on it and the foliation of the form.
struct Foliated {
  Harmonic h;
  HolomorphicForm form;
  Foliation foliation;

  const Connectivity& mesh() const { return h.mesh; }
};

inline Foliated foliated(Harmonic h, const Eigen::VectorXd& lambda) {
  Foliated result;
  result.form = h.form(lambda);
  result.foliation = foliate(h.mesh, result.form);
  result.h = std::move(h);
  return result;
}

/// With the form of least energy.
inline Foliated foliated(const TriangleSurface& surface) {
  Harmonic h = harmonic(surface);
  const Eigen::VectorXd lambda = optimum_of(h).lambda;
  return foliated(std::move(h), lambda);
}

/// The statements that hold for the foliation of any form on any surface.
class FoliationChecks {
 public:
  explicit FoliationChecks(const Foliated& s)
      : mesh_(s.mesh()), form_(s.form), foliation_(s.foliation), n_(s.h.n()) {
    scale_ = 0.5 * form_.periods.cwiseAbs().sum();
    range_ = form_.y.maxCoeff() - form_.y.minCoeff();
    double longest = 0.0;
    for (const Arc& arc : foliation_.graph.arcs) {
      longest = std::max(longest, arc.curve.length());
    }
    // Arcs too short for x to advance are given a small length.
    tolerance_ = 1e-9 * scale_;
    for (const Arc& arc : foliation_.graph.arcs) {
      if (arc.curve.corrected && arc.curve.length() < 1.001e-6 * longest) {
        tolerance_ += 1e-5 * longest;
      }
    }
  }

  void all() const {
    orders();
    counts();
    cylinder_tree();
    circles();
    flux();
    arcs();
    level_curves();
    strips();
    labels();
  }

  void orders() const {
    EXPECT_EQ(foliation_.doubled_order(), 2 * (n_ - 1));
    EXPECT_EQ(foliation_.boundary_half_zeros() % 2, 0);
    int interior = 0;
    for (const Zero& zero : foliation_.graph.zeros) {
      EXPECT_EQ(zero.loop, mesh_.loop_of_vertex(zero.vertex));
      if (zero.loop >= 0) continue;
      EXPECT_EQ(zero.doubled_order % 2, 0);
      interior += zero.doubled_order / 2;
    }
    EXPECT_EQ(foliation_.interior_zeros(), interior);
    EXPECT_EQ(2 * interior + foliation_.boundary_half_zeros(), 2 * (n_ - 1));
  }

  void counts() const {
    const auto& zeros = foliation_.graph.zeros;
    const auto interior =
        std::count_if(zeros.begin(), zeros.end(), [](const Zero& zero) { return zero.loop < 0; });
    // The Reeb tree: a node per loop and per interior zero.
    EXPECT_EQ(static_cast<int>(foliation_.cylinders.size()), n_ + interior);
    // Euler's number: cutting along the 2 k + 2 lines of an interior zero of order k adds 2 k + 1
    // to it, along the d + 1 lines of a zero of doubled order d on a loop d + 1.
    const int count = static_cast<int>(zeros.size());
    EXPECT_EQ(foliation_.strips.count(), n_ == 1 ? 1 : n_ - 1 + count);
    if (std::any_of(zeros.begin(), zeros.end(), [](const Zero& zero) {
          return zero.doubled_order != (zero.loop < 0 ? 2 : 1);
        })) {
      return;
    }
    const int half_zeros = foliation_.boundary_half_zeros();
    EXPECT_EQ(foliation_.strips.count(), n_ == 1 ? 1 : 2 * (n_ - 1) + half_zeros / 2);
    if (half_zeros == 0) {
      EXPECT_EQ(static_cast<int>(foliation_.cylinders.size()), 2 * n_ - 1);
    }
  }

  /// The cylinders join the components to a tree, each from a lower to a higher one.
  void cylinder_tree() const {
    const auto& components = foliation_.graph.components;
    ASSERT_EQ(foliation_.cylinders.size() + 1, components.size());
    for (const Cylinder& c : foliation_.cylinders) {
      EXPECT_LT(components[c.bottom].rank, components[c.top].rank);
      EXPECT_LE(c.y_bottom, c.y_top);
      EXPECT_EQ(c.y_bottom, components[c.bottom].y);
      EXPECT_EQ(c.y_top, components[c.top].y);
    }
    const std::vector<bool> reached = side_of(-1, 0);
    EXPECT_TRUE(std::all_of(reached.begin(), reached.end(), [](bool b) { return b; }));
  }

  void circles() const {
    for (const Cylinder& c : foliation_.cylinders) {
      EXPECT_GT(c.circumference(), 0.0);
      EXPECT_NEAR(c.top_circle.length, c.bottom_circle.length, tolerance_);
      for (const Circle* circle : {&c.bottom_circle, &c.top_circle}) {
        double sum = 0.0;
        for (std::size_t i = 0; i < circle->arcs.size(); ++i) {
          EXPECT_EQ(circle->start[i], sum);
          const Arc& arc = foliation_.graph.arcs[circle->arcs[i]];
          sum += arc.curve.length();
          const bool is_bottom = circle == &c.bottom_circle;
          EXPECT_EQ(arc.component, is_bottom ? c.bottom : c.top);
          EXPECT_TRUE(is_bottom ? arc.has_upper : arc.has_lower);
        }
        EXPECT_EQ(circle->length, sum);
      }
    }
  }

  /// What flows through a cylinder comes from the loops below it; nothing is lost at zeros.
  void flux() const {
    const auto& components = foliation_.graph.components;
    for (std::size_t i = 0; i < foliation_.cylinders.size(); ++i) {
      const std::vector<bool> below = side_of(static_cast<int>(i), foliation_.cylinders[i].bottom);
      double sum = 0.0;
      for (std::size_t k = 0; k < components.size(); ++k) {
        if (below[k] && components[k].loop >= 0) sum += form_.periods[components[k].loop];
      }
      EXPECT_NEAR(foliation_.cylinders[i].circumference(), sum, tolerance_) << "cylinder " << i;
    }
    for (std::size_t k = 0; k < components.size(); ++k) {
      double balance = 0.0;
      for (const Cylinder& c : foliation_.cylinders) {
        if (c.bottom == static_cast<int>(k)) balance += c.bottom_circle.length;
        if (c.top == static_cast<int>(k)) balance -= c.top_circle.length;
      }
      const int loop = components[k].loop;
      EXPECT_NEAR(balance, loop < 0 ? 0.0 : form_.periods[loop], tolerance_) << "component " << k;
    }
  }

  void arcs() const {
    for (const Arc& arc : foliation_.graph.arcs) {
      EXPECT_EQ(arc.curve.start(), 0.0);
      EXPECT_GT(arc.curve.length(), 0.0);
      expect_level(arc.curve, foliation_.graph.components[arc.component].y);
    }
  }

  void level_curves() const {
    for (const Cylinder& c : foliation_.cylinders) {
      for (const double fraction : {1e-6, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0 - 1e-6}) {
        const double y = c.y_bottom + fraction * c.height();
        if (y <= c.y_bottom || y >= c.y_top) continue;  // too low a cylinder
        const LevelCurve curve = level_curve(mesh_, form_, c, y);
        expect_level(curve, y);
        EXPECT_NEAR(curve.length(), c.circumference(), tolerance_);
        EXPECT_EQ(curve.points.front().halfedge, curve.points.back().halfedge);
      }
    }
  }

  void strips() const {
    const Strips& strips = foliation_.strips;
    for (const double width : strips.width) EXPECT_GE(width, 0.0);
    for (std::size_t i = 0; i < foliation_.cylinders.size(); ++i) {
      const auto& lines = strips.in_cylinder[i];
      ASSERT_FALSE(lines.empty());
      double sum = 0.0;
      for (std::size_t k = 0; k < lines.size(); ++k) {
        sum += strips.width[lines[k].strip];
        EXPECT_GE(lines[k].x_bottom, lines[k == 0 ? 0 : k - 1].x_bottom);
        EXPECT_NEAR(lines[k].x_bottom, lines[k].x_top, 10.0 * tolerance_);
      }
      EXPECT_NEAR(sum, foliation_.cylinders[i].circumference(), 10.0 * tolerance_);
    }
    expect_loop_to_loop();
  }

  /// Every triangle belongs to a cylinder and a patch, and x continues across edges up to full
  /// turns, on any way up to the same place of the top circle.
  void labels() const {
    const std::vector<int> across(foliation_.strips.width.size(), 3);
    const std::vector<int> along(foliation_.cylinders.size(), 2);
    std::vector<RowSpacing> spacing;
    for (const Cylinder& c : foliation_.cylinders) {
      spacing.push_back({{c.y_bottom, c.y_top}, {0.0, 2.0}});
    }
    const SurfaceLabels labels = label_surface(mesh_, form_, foliation_, across, along, spacing);
    expect_all_labelled(labels);
    expect_continuous(labels);
    for (std::size_t i = 0; i < foliation_.cylinders.size(); ++i) {
      const Cylinder& c = foliation_.cylinders[i];
      const int number = static_cast<int>(i);
      expect_coordinate(labels, number, c.bottom_circle, 0.0);
      expect_coordinate(labels, number, c.top_circle, c.twist);
    }
  }

 private:
  // Components reachable from `start` without passing through cylinder `without`.
  std::vector<bool> side_of(int without, int start) const {
    std::vector<bool> reached(foliation_.graph.components.size(), false);
    reached[start] = true;
    for (bool grows = true; grows;) {
      grows = false;
      for (std::size_t i = 0; i < foliation_.cylinders.size(); ++i) {
        const Cylinder& c = foliation_.cylinders[i];
        if (static_cast<int>(i) == without || reached[c.bottom] == reached[c.top]) continue;
        reached[c.bottom] = reached[c.top] = grows = true;
      }
    }
    return reached;
  }

  // A polyline through triangles, on one level, along which x does not fall.
  void expect_level(const LevelCurve& curve, double y) const {
    ASSERT_EQ(curve.points.size(), curve.x.size());
    ASSERT_EQ(curve.points.size(), curve.faces.size() + 1);
    EXPECT_TRUE(std::is_sorted(curve.x.begin(), curve.x.end()));
    for (const EdgePoint& p : curve.points) {
      const double at =
          (1.0 - p.t) * form_.y[mesh_.tail(p.halfedge)] + p.t * form_.y[mesh_.tip(p.halfedge)];
      ASSERT_NEAR(at, y, 1e-12 * range_);
    }
    for (std::size_t i = 0; i < curve.faces.size(); ++i) {
      ASSERT_TRUE(touches(curve.points[i], curve.faces[i]));
      ASSERT_TRUE(touches(curve.points[i + 1], curve.faces[i]));
    }
  }

  // Whether a point lies on the outline of a triangle: at a corner, or on an edge.
  bool touches(const EdgePoint& p, int face) const {
    const auto has = [&](int v) {
      const auto& corners = mesh_.triangles()[face];
      return std::find(corners.begin(), corners.end(), v) != corners.end();
    };
    if (p.t == 0.0 && has(mesh_.tail(p.halfedge))) return true;
    if (p.t == 1.0 && has(mesh_.tip(p.halfedge))) return true;
    return has(mesh_.tail(p.halfedge)) && has(mesh_.tip(p.halfedge));
  }

  // Each strip starts at one boundary loop and ends at one.
  void expect_loop_to_loop() const {
    std::vector<int> starts(foliation_.strips.width.size(), 0);
    std::vector<int> ends = starts;
    for (std::size_t a = 0; a < foliation_.graph.arcs.size(); ++a) {
      const Arc& arc = foliation_.graph.arcs[a];
      ASSERT_TRUE(arc.has_upper || arc.has_lower);
      if (arc.has_upper && arc.has_lower) continue;
      EXPECT_GE(foliation_.graph.components[arc.component].loop, 0);
      for (const int strip : foliation_.strips.arc_strips[a]) {
        ++(arc.has_upper ? starts : ends)[strip];
      }
    }
    for (std::size_t s = 0; s < starts.size(); ++s) {
      EXPECT_EQ(starts[s], 1) << "strip " << s;
      EXPECT_EQ(ends[s], 1) << "strip " << s;
    }
  }

  void expect_all_labelled(const SurfaceLabels& labels) const {
    std::size_t patches = 0;
    std::vector<std::size_t> first_patch;
    for (const auto& lines : foliation_.strips.in_cylinder) {
      first_patch.push_back(patches);
      patches += lines.size();
    }
    for (int f = 0; f < mesh_.face_count(); ++f) {
      const int c = labels.cylinder[f];
      ASSERT_GE(c, 0) << "triangle " << f;
      const auto& [i, j, k] = mesh_.triangles()[f];
      const double middle = (form_.y[i] + form_.y[j] + form_.y[k]) / 3.0;
      ASSERT_GE(middle, foliation_.cylinders[c].y_bottom);
      ASSERT_LE(middle, foliation_.cylinders[c].y_top);
      ASSERT_GE(labels.patch[f], static_cast<int>(first_patch[c]));
      ASSERT_LT(labels.patch[f],
                static_cast<int>(first_patch[c] + foliation_.strips.in_cylinder[c].size()));
      for (int side = 0; side < 3; ++side) {
        ASSERT_NEAR(labels.x[f][(side + 1) % 3] - labels.x[f][side],
                    form_.dx.along(mesh_, 3 * f + side), tolerance_);
      }
    }
  }

  bool crosses(const Cylinder& c, int h) const {
    const auto [low, high] =
        std::minmax(foliation_.ranks[mesh_.tail(h)], foliation_.ranks[mesh_.tip(h)]);
    return low < foliation_.graph.components[c.top].rank &&
           high > foliation_.graph.components[c.bottom].rank;
  }

  void expect_continuous(const SurfaceLabels& labels) const {
    for (int e = 0; e < mesh_.edge_count(); ++e) {
      if (mesh_.is_boundary_edge(e)) continue;
      const int h = mesh_.halfedge(e);
      const int g = mesh_.twin(h);
      const int c = labels.cylinder[h / 3];
      if (c != labels.cylinder[g / 3] || !crosses(foliation_.cylinders[c], h)) continue;
      const double jump = labels.x[h / 3][h % 3] - labels.x[g / 3][(g % 3 + 1) % 3];
      const double turn = foliation_.cylinders[c].circumference();
      ASSERT_NEAR(std::remainder(jump, turn), 0.0, 10.0 * tolerance_);
    }
  }

  // On a circle of cylinder c, x plus `shift` is the circle's own coordinate, up to full turns.
  void expect_coordinate(const SurfaceLabels& labels, int c, const Circle& circle,
                         double shift) const {
    for (std::size_t i = 0; i < circle.arcs.size(); ++i) {
      const LevelCurve& curve = foliation_.graph.arcs[circle.arcs[i]].curve;
      if (curve.corrected) continue;
      for (std::size_t k = 1; k + 1 < curve.points.size(); ++k) {
        const EdgePoint& p = curve.points[k];
        const double expected = circle.start[i] + curve.x[k] - shift;
        const int g = mesh_.twin(p.halfedge);
        expect_x(labels, c, p.halfedge, p.t, expected, circle.length);
        if (g >= 0) expect_x(labels, c, g, 1.0 - p.t, expected, circle.length);
      }
    }
  }

  void expect_x(const SurfaceLabels& labels, int c, int h, double t, double expected,
                double turn) const {
    if (labels.cylinder[h / 3] != c) return;
    const auto& x = labels.x[h / 3];
    const double actual = (1.0 - t) * x[h % 3] + t * x[(h % 3 + 1) % 3];
    ASSERT_NEAR(std::remainder(actual - expected, turn), 0.0, 10.0 * tolerance_)
        << "cylinder " << c;
  }

  const Connectivity& mesh_;
  const HolomorphicForm& form_;
  const Foliation& foliation_;
  int n_;
  double scale_ = 1.0, range_ = 1.0, tolerance_ = 0.0;
};

}  // namespace hexwall::test
