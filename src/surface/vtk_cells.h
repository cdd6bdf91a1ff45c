#pragma once

#include <vector>

#include "surface/polygon_soup.h"

namespace hexwall {

/// Cells of VTK's kinds as they stand in a file. Corners that are no index of a point are -1.
struct VtkGrid {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> cells;  ///< corners; of a polyhedron its face stream
  std::vector<int> types;               ///< #cells, of vtkCellType.h
};

/// Adds cells of VTK's kinds to a polygon soup, and counts those that are no part of a surface.
class VtkCells {
 public:
  /// `type` is one of vtkCellType.h. \throws ReadError if a cell lacks corners.
  void add(int type, std::vector<int> corners);

  /// Tells the polygons apart: the number of the cell that each one comes from.
  const std::vector<int>& cell_of_polygon() const { return cell_of_polygon_; }

  /// Moves the polygons to a soup, with notes on what was left out.
  void move_to(PolygonSoup& soup);

 private:
  void add_strip(const std::vector<int>& strip);

  std::vector<std::vector<int>> polygons_;
  std::vector<int> cell_of_polygon_;
  int cells_ = 0;
  int lower_ = 0;   // vertices and lines
  int higher_ = 0;  // volume cells, curved cells
};

}  // namespace hexwall
