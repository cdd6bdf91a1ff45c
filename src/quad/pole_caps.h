#pragma once

#include <vector>

#include "quad/quad_mesh.h"
#include "surface/projector.h"

namespace hexwall {

/// A pole to be closed.
struct PoleSite {
  int loop = -1;                ///< of the quad mesh
  SurfacePoint center;          ///< of the disk that was taken out
  std::vector<int> disk_faces;  ///< triangles of the surface that cover it
};

/// The quads that close a pole.
struct PoleCap {
  int loop = -1;           ///< of the quad mesh
  int around = 0;          ///< quads around the loop: four times those along a side of the cap
  int first_quad = -1;     ///< its (around / 4)^2 quads follow each other
  double mean_edge = 0.0;  ///< root of the mean area of a quad
};

/// Closes a pole's loop with a square grid of quads, four corners of valence 3 on the former loop,
/// which becomes an interior line of the mesh.
///
/// The grid and the regular rings of quads around it are laid out in the plane by a discrete
/// harmonic map (uniform weights, the outermost ring on a circle), which turns the loop into a
/// square with rounded corners, and taken to the surface in polar coordinates around the centre:
/// angles are columns of quads, radii follow the rings' conformal spacing. Quads of a cap have
/// cylinder -1 and a patch of their own.
/// \param places #V triangle and position of every vertex; moved and new ones are on the
/// projector's surface.
/// \param ring_spacing #Q height over width of each quad in the (x, y) plane.
/// \pre the loop has a multiple of 4 vertices.
PoleCap close_pole(QuadMesh& mesh, std::vector<SurfacePoint>& places, const PoleSite& site,
                   const std::vector<double>& ring_spacing, const SurfaceProjector& projector);

}  // namespace hexwall
