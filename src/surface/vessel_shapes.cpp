#include "surface/vessel_shapes.h"

namespace hexwall {
namespace {

/// A branch that starts inside another one and ends open.
Branch side_branch(std::vector<Vec3> centerline, std::vector<double> radii, double blend) {
  return {std::move(centerline), std::move(radii), false, true, blend};
}

Branch aorta() {
  return {{{0, 0, 80},
           {0, 0, 52},
           {0, 0, 25},
           {0, 0, 0},
           {0, 0, -24},
           {1, 3, -48},
           {2, 6, -72},
           {2, 4, -96},
           {0, 1, -118},
           {0, 0, -132}},
          {11.8, 11.5, 11.2, 10.8, 11.0, 21.0, 27.0, 21.0, 12.0, 10.0},
          true,
          false,
          0.0};
}

Branch celiac() {
  return side_branch({{0, 6, 24}, {1, 16, 24}, {3, 26, 26}, {6, 37, 28}}, {3.6, 3.5, 3.4, 3.3}, 5);
}

Branch superior_mesenteric() {
  return side_branch({{0, 6, 4}, {0, 16, 3}, {-1, 26, -1}, {-2, 37, -8}}, {3.7, 3.6, 3.4, 3.3}, 5);
}

Branch right_renal() {
  return side_branch({{-5, 0, -12}, {-18, 1, -14}, {-32, -3, -17}, {-45, -10, -20}},
                     {3.0, 2.9, 2.8, 2.7}, 4);
}

Branch left_renal() {
  return side_branch({{5, 0, -8}, {18, 1, -9}, {32, -3, -12}, {45, -10, -15}}, {3.0, 2.9, 2.8, 2.7},
                     4);
}

Branch inferior_mesenteric() {
  return side_branch({{3, 6, -108}, {8, 19, -115}, {14, 28, -126}, {19, 34, -139}},
                     {2.3, 2.2, 2.1, 2.0}, 4);
}

/// Common and external iliac artery of one side: -1 the right one, +1 the left one.
Branch iliac(double side) {
  return side_branch({{3 * side, 0, -128},
                      {11 * side, 1, -146},
                      {20 * side, -1, -166},
                      {30 * side, -3, -188},
                      {41 * side, 1, -210},
                      {51 * side, 11, -232},
                      {58 * side, 25, -253}},
                     {7.0, 6.7, 6.4, 6.0, 5.2, 4.8, 4.5}, 8);
}

Branch internal_iliac(double side) {
  return side_branch({{29 * side, -3, -186},
                      {28 * side, -16, -196},
                      {26 * side, -28, -210},
                      {25 * side, -37, -227}},
                     {4.0, 3.8, 3.6, 3.5}, 6);
}

}  // namespace

std::vector<Branch> bifurcation_branches() {
  return {{{{0, 0, 6}, {0, 0, 3}, {0, 0, 0}}, {1.0, 1.0, 0.9}, true, false, 0.0},
          side_branch({{0, 0, 0.5}, {0.9, 0, -1}, {2.2, 0, -3}, {3.5, 0, -5}},
                      {0.85, 0.8, 0.8, 0.8}, 0.6),
          side_branch({{0, 0, 0.5}, {-0.9, 0, -1}, {-2.2, 0, -3}, {-3.5, 0, -5}},
                      {0.8, 0.7, 0.7, 0.7}, 0.6)};
}

std::vector<Branch> aaa_branches() {
  return {aorta(),           celiac(),     superior_mesenteric(),
          right_renal(),     left_renal(), inferior_mesenteric(),
          iliac(-1),         iliac(+1),    internal_iliac(-1),
          internal_iliac(+1)};
}

}  // namespace hexwall
