#pragma once

#include <optional>
#include <string_view>

#include "surface/triangle_surface.h"

namespace hexwall {

/// Surfaces the program can make itself, for trials and tests.
enum class Shape {
  annulus,            ///< planar, radii 1 and 2 around the origin
  eccentric_annulus,  ///< planar, radius 1 around the origin, hole of radius 0.3 around (0.4, 0)
  cylinder,           ///< radius 1, length 4 pi, around the z axis
  bifurcation,        ///< three branches of radii 1, 0.8 and 0.7
  aaa                 ///< abdominal aortic aneurysm with 10 ends, in mm
};

/// \throws UsageError, listing the names, if `name` is none of annulus, eccentric-annulus,
/// cylinder, bifurcation, aaa.
Shape shape_from_name(std::string_view name);

/// Makes a shape with triangles of about the edge length `edge`, in the shape's unit; the default
/// is fine enough for the shape (aaa: 26,165 vertices within 2 %). Deterministic. The triangles are
/// counter-clockwise seen from outside, in the planar shapes from +z.
/// \throws UsageError if `edge` is not positive, too long for the shape, or so short that the shape
/// would take more than 10 million vertices.
TriangleSurface generate_shape(Shape shape, std::optional<double> edge = std::nullopt);

/// Planar annulus around the origin: n_radial + 1 rings of n_around vertices, their radii in
/// geometric progression, every second ring turned by half a step. All triangles are similar but
/// for the orientation; they are nearly equilateral if n_radial = log(outer/inner) n_around / (pi
/// √3). \pre 0 < inner < outer, n_around >= 3, n_radial >= 1.
TriangleSurface annulus(double inner, double outer, int n_around, int n_radial);

/// Planar region between the circle of radius `outer` around the origin and the one of radius
/// `inner` around (offset, 0), blended linearly between the two.
/// \pre 0 < inner, |offset| + inner < outer, n_around >= 3, n_radial >= 1.
TriangleSurface eccentric_annulus(double outer, double inner, double offset, int n_around,
                                  int n_radial);

/// Cylinder around the z axis from z = 0 to `length`: n_along + 1 rings of n_around vertices, every
/// second ring turned by half a step. Near equilateral if length/n_along = √3 pi radius/n_around.
/// \pre radius, length > 0, n_around >= 3, n_along >= 1.
TriangleSurface cylinder(double radius, double length, int n_around, int n_along);

}  // namespace hexwall
