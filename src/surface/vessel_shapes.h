#pragma once

#include <vector>

#include "surface/vessel_tree.h"

namespace hexwall {

/// A symmetric-plane Y: one branch of radius 1 along z that divides in two of radii 0.8 and 0.7.
/// 3 open ends.
std::vector<Branch> bifurcation_branches();

/// Abdominal aortic aneurysm in mm, z towards the head, y to the front, x to the patient's left:
/// aorta with a fusiform sac of 54 mm, coeliac, superior mesenteric, both renal and inferior
/// mesenteric arteries, and both common iliacs, each dividing in an external and an internal one.
/// 10 open ends. Radii after the usual reference values of vascular surgery.
std::vector<Branch> aaa_branches();

}  // namespace hexwall
