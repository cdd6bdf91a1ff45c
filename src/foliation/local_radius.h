#pragma once

#include <vector>

#include "foliation/foliation.h"

namespace hexwall {

/// Local radius of the vessel at each vertex: the length of the level loop y = const through it
/// over 2 pi, smoothed along the surface by one implicit step of diffusion over a distance of one
/// mean radius, so that it passes evenly from a trunk to its branches. #V, in the surface's unit.
/// Loops of a blind sac are those of the form, which without poles are few and large. From a pole
/// to the widest loop around it, the radius is that of the widest loop: level loops shrink towards
/// the pole, the sac does not. \param first_pole loops from this number on are poles.
std::vector<double> local_radius(const TriangleSurface& surface, const Connectivity& mesh,
                                 const HolomorphicForm& form, const Foliation& foliation,
                                 int first_pole);

}  // namespace hexwall
