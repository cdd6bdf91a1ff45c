#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall {

/// A patch of type `wall` and the shear stress on its faces, as OpenFOAM's incompressible solvers
/// write it: over the density, in m²/s², of the fluid on the wall's side.
struct RunWall {
  std::string name;
  std::vector<Vec3> points;             ///< m
  std::vector<std::vector<int>> faces;  ///< corners, counter-clockwise seen from outside the fluid
  std::vector<double> areas;            ///< #faces, m²
  std::vector<Vec3> shear;              ///< #faces, at `RunWalls::time`
  std::vector<Vec3> mean_shear;         ///< #faces means over the averaged time; or empty
  std::vector<double> mean_magnitude;   ///< #faces the same of the magnitude; or empty
};

struct RunWalls {
  double time = 0.0;  ///< the last one that was written; of steady flow, the number of iterations
  std::vector<RunWall> walls;
};

/// Reads the walls of an OpenFOAM case after its run, text or binary: the fields wallShearStress
/// and, if they are there, wallShearStressMean and wallShearStressMagnitudeMean of the last time.
/// \throws ReadError if there is no case, no run, a run that is still in parts of its processes, or
/// no wall shear stress.
RunWalls read_run(const std::filesystem::path& case_dir);

}  // namespace hexwall
