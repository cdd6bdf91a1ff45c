#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall {

/// Shapes of cells, with the numbers and the order of corners that VTK has for them.
enum class CellShape : unsigned char {
  tetrahedron = 10,
  hexahedron = 12,
  wedge = 13,
  pyramid = 14
};

/// A face of a cell: vertices counter-clockwise seen from outside the cell, the fourth -1 in a
/// triangle.
struct CellFace {
  std::array<int, 4> vertices;
  int cell;

  int size() const { return vertices[3] < 0 ? 3 : 4; }
};

/// A named part of the boundary, or a named set of faces between two regions: then each face is
/// that of the cell in the first region.
struct CellPatch {
  std::string name;
  bool is_wall = false;  ///< OpenFOAM type `wall` rather than `patch`
  std::vector<CellFace> faces;
};

/// A named set of cells.
struct CellGroup {
  std::string name;
  std::vector<int> cells;
};

/// A conforming mesh of hexahedra, pyramids, tetrahedra and wedges.
struct CellMesh {
  std::vector<Vec3> points;
  std::vector<CellShape> shape;       ///< #C
  std::vector<int> connectivity;      ///< corners of all cells, one after the other
  std::vector<int> offset{0};         ///< #C + 1: where the corners of each cell begin
  std::vector<CellPatch> patches;     ///< partition of all boundary faces
  std::vector<CellGroup> zones;       ///< partition of all cells
  std::vector<CellGroup> regions;     ///< coarser partition: `lumen` and `wall`, as far as there
  std::vector<CellPatch> face_zones;  ///< `interface` between the regions, if there are two

  int cells() const { return static_cast<int>(shape.size()); }
  std::span<const int> corners(int cell) const {
    return {connectivity.data() + offset[cell], connectivity.data() + offset[cell + 1]};
  }
  void reserve(std::size_t cells, std::size_t all_corners) {
    shape.reserve(cells);
    connectivity.reserve(all_corners);
    offset.reserve(cells + 1);
  }
  void add(CellShape kind, std::span<const int> vertices) {
    shape.push_back(kind);
    connectivity.insert(connectivity.end(), vertices.begin(), vertices.end());
    offset.push_back(static_cast<int>(connectivity.size()));
  }
};

}  // namespace hexwall
