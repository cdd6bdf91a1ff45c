#include "surface/generate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "core/errors.h"
#include "surface/vessel_shapes.h"
#include "surface/vessel_tree.h"

namespace hexwall {
namespace {

using std::numbers::pi;

// Rows of equilateral triangles lie this many edge lengths apart.
constexpr double row_height = 0.5 * std::numbers::sqrt3;

// A few GB of memory; nobody generates more on purpose.
constexpr double max_vertices = 1e7;

struct NamedShape {
  std::string_view name;
  Shape shape;
};

constexpr std::array<NamedShape, 5> shapes{{{"annulus", Shape::annulus},
                                            {"eccentric-annulus", Shape::eccentric_annulus},
                                            {"cylinder", Shape::cylinder},
                                            {"bifurcation", Shape::bifurcation},
                                            {"aaa", Shape::aaa}}};

/// Rings of `n_around` vertices, joined by triangles. `place(row, angle)` gives a vertex; rows grow
/// to the right of the direction of growing angle, seen from outside.
template <typename Place>
TriangleSurface staggered_rings(int n_around, int n_rows, Place place) {
  TriangleSurface surface;
  for (int row = 0; row <= n_rows; ++row) {
    const double shift = row % 2 == 0 ? 0.0 : 0.5;
    for (int i = 0; i < n_around; ++i) {
      surface.points.push_back(place(row, 2.0 * pi * (i + shift) / n_around));
    }
  }
  for (int row = 0; row < n_rows; ++row) {
    for (int i = 0; i < n_around; ++i) {
      const int next = (i + 1) % n_around;
      const int a = row * n_around;
      const int b = a + n_around;
      if (row % 2 == 0) {
        surface.triangles.push_back({a + i, b + i, a + next});
        surface.triangles.push_back({a + next, b + i, b + next});
      } else {
        surface.triangles.push_back({a + i, b + i, b + next});
        surface.triangles.push_back({a + i, b + next, a + next});
      }
    }
  }
  return surface;
}

int at_least(int minimum, double count) {
  return std::max(minimum, static_cast<int>(std::lround(count)));
}

/// Number of edges around a circle, refused if they do not resemble a circle any more.
int count_around(double radius, double edge) {
  const double count = 2.0 * pi * radius / edge;
  if (count < 6.0) {
    throw UsageError(
        fmt::format("an edge length of {} is too long for this shape: use at most {:.3g}", edge,
                    pi * radius / 3.0));
  }
  return at_least(6, count);
}

TriangleSurface make_annulus(double edge) {
  const double inner = 1.0;
  const double outer = 2.0;
  const int n_around = count_around(std::sqrt(inner * outer), edge);
  const double step = row_height * 2.0 * pi / n_around;
  return annulus(inner, outer, n_around, at_least(1, std::log(outer / inner) / step));
}

TriangleSurface make_eccentric_annulus(double edge) {
  const double outer = 1.0;
  const double inner = 0.3;
  const int n_around = count_around(0.5 * (outer + inner), edge);
  const int n_radial = at_least(1, (outer - inner) / (row_height * edge));
  return eccentric_annulus(outer, inner, 0.4, n_around, n_radial);
}

TriangleSurface make_cylinder(double edge) {
  const double length = 4.0 * pi;
  const int n_along = at_least(1, length / (row_height * edge));
  return cylinder(1.0, length, count_around(1.0, edge), n_along);
}

// The default of aaa is the edge length that gives 26,165 vertices.
double default_edge(Shape shape) {
  switch (shape) {
    case Shape::annulus:
    case Shape::eccentric_annulus:
      return 0.05;
    case Shape::cylinder:
      return 0.1;
    case Shape::bifurcation:
      return 0.12;
    case Shape::aaa:
      return 1.441;
  }
  throw UsageError("unknown shape");
}

double approximate_area(Shape shape) {
  switch (shape) {
    case Shape::annulus:
      return 3.0 * pi;
    case Shape::eccentric_annulus:
      return 0.91 * pi;
    case Shape::cylinder:
      return 8.0 * pi * pi;
    case Shape::bifurcation:
      return 92.0;
    case Shape::aaa:
      return 36500.0;
  }
  throw UsageError("unknown shape");
}

void check_edge(Shape shape, double edge) {
  if (!(edge > 0.0) || !std::isfinite(edge)) {
    throw UsageError(fmt::format("the edge length has to be positive, not {}", edge));
  }
  // Each vertex stands for two equilateral triangles.
  const double vertex_count = approximate_area(shape) / (row_height * edge * edge);
  if (vertex_count > max_vertices) {
    throw UsageError(
        fmt::format("an edge length of {} is too short for this shape: it would take "
                    "about {:.1e} vertices",
                    edge, vertex_count));
  }
}

}  // namespace

Shape shape_from_name(std::string_view name) {
  std::string known;
  for (const NamedShape& s : shapes) {
    if (s.name == name) return s.shape;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", s.name);
  }
  throw UsageError(fmt::format("unknown shape '{}'. Known are {}", name, known));
}

TriangleSurface generate_shape(Shape shape, std::optional<double> edge) {
  const double h = edge.value_or(default_edge(shape));
  check_edge(shape, h);
  switch (shape) {
    case Shape::annulus:
      return make_annulus(h);
    case Shape::eccentric_annulus:
      return make_eccentric_annulus(h);
    case Shape::cylinder:
      return make_cylinder(h);
    case Shape::bifurcation:
      return vessel_tree(bifurcation_branches(), h);
    case Shape::aaa:
      return vessel_tree(aaa_branches(), h);
  }
  throw UsageError("unknown shape");
}

TriangleSurface annulus(double inner, double outer, int n_around, int n_radial) {
  return staggered_rings(n_around, n_radial, [=](int row, double angle) {
    const double radius =
        row == n_radial ? outer
                        : inner * std::pow(outer / inner, static_cast<double>(row) / n_radial);
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  });
}

TriangleSurface eccentric_annulus(double outer, double inner, double offset, int n_around,
                                  int n_radial) {
  return staggered_rings(n_around, n_radial, [=](int row, double angle) {
    const double s = static_cast<double>(row) / n_radial;
    const double radius = (1.0 - s) * inner + s * outer;
    return Vec3((1.0 - s) * offset + radius * std::cos(angle), radius * std::sin(angle), 0.0);
  });
}

TriangleSurface cylinder(double radius, double length, int n_around, int n_along) {
  // Going down with growing row keeps the rows on the right of growing angle, seen from outside.
  return staggered_rings(n_around, n_along, [=](int row, double angle) {
    const double z = length * (n_along - row) / n_along;
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), z);
  });
}

}  // namespace hexwall
