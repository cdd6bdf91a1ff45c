#pragma once

#include <string>
#include <vector>

#include "surface/repair.h"
#include "surface/triangle_surface.h"

namespace hexwall::test {

/// A tube with one fault that one step of the repair finds.
struct Fault {
  std::string name;
  RepairStep step;
  int count;  ///< what the step reports
  TriangleSurface surface;

  /// Steps that have to do one thing each before the fault can be found.
  std::vector<RepairStep> before{};

  /// Steps that, one after the other, repair the fault too where its own step is switched off.
  std::vector<RepairStep> instead{};
};

/// The tube: radius 1, length 3, around the z axis; 48 by 24 vertices and two loops.
TriangleSurface sound_tube();

/// One for each fault that the steps up to `orient` repair.
std::vector<Fault> topology_faults();

/// One for each fault of the other steps.
std::vector<Fault> geometry_faults();

/// Adds a copy of `other`, moved by `offset`; returns the number of its first vertex.
int append(TriangleSurface& surface, const TriangleSurface& other, const Vec3& offset);

}  // namespace hexwall::test
