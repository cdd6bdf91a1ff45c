#pragma once

#include <array>
#include <vector>

#include "foliation/foliation.h"
#include "foliation/row_spacing.h"

namespace hexwall {

/// Where each triangle of the refined surface lies in the foliation, by its centroid.
struct SurfaceLabels {
  std::vector<int> cylinder;              ///< #F
  std::vector<int> patch;                 ///< #F patch number, as on the quads
  std::vector<std::array<double, 3>> x;   ///< #F x at the corners, lifted within the cylinder
  std::vector<std::array<double, 6>> uv;  ///< #F (u, v) at the corners: integers are grid lines
};

/// \param across quads across each strip. \param along quads along each cylinder, spread as
/// `spacing` says.
SurfaceLabels label_surface(const Connectivity& mesh, const HolomorphicForm& form,
                            const Foliation& foliation, const std::vector<int>& across,
                            const std::vector<int>& along, const std::vector<RowSpacing>& spacing);

}  // namespace hexwall
