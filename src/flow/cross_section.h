#pragma once

#include <complex>
#include <memory>
#include <vector>

#include "hex/cell_mesh.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// Developed flow through an opening of any shape, on the opening's own faces: what the velocity is
/// far down a straight tube of this cross-section.
///
/// Linear finite elements on the faces, each cut into triangles around its centre; u = 0 on the
/// rim. Of a face, the result is the mean over the face, which is what a finite-volume solver takes
/// for its flux: second order in the size of the faces, on triangles, quads or both. All profiles
/// have the mean 1: Σ u_f A_f = Σ A_f to rounding, with A_f the area of face f across `normal`.
class CrossSection {
 public:
  /// \param faces of an opening, counter-clockwise seen from outside the lumen; planar or nearly so
  /// \throws Error(internal) if there is no face, or the faces have no rim or no area.
  CrossSection(const std::vector<Vec3>& points, const std::vector<CellFace>& faces);
  ~CrossSection();
  CrossSection(CrossSection&&) noexcept;
  CrossSection& operator=(CrossSection&&) noexcept;

  /// Unit normal out of the lumen: that of the sum of the faces' area vectors.
  const Vec3& normal() const;
  /// Sum of `face_areas`, in the square of the points' unit.
  double area() const;
  /// Length of the rim.
  double perimeter() const;
  /// #faces areas of the faces' projections along `normal`.
  const std::vector<double>& face_areas() const;
  /// #faces centres of area, on the faces.
  const std::vector<Vec3>& face_centers() const;

  /// Poiseuille flow: -Δu = 1, scaled. #faces.
  std::vector<double> steady() const;

  /// The amplitude of Womersley flow whose flow rate is cos(ωt): i(ω/ν)v - Δv = 1, scaled by a
  /// complex number; the velocity is Re(u e^{iωt}). #faces. (Womersley, J Physiol 127:553, 1955,
  /// for the circle.)
  /// \param omega_over_nu angular frequency over kinematic viscosity, in 1 / the square of the
  /// points' unit; not negative. 0 gives `steady`.
  std::vector<std::complex<double>> oscillating(double omega_over_nu) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace hexwall
