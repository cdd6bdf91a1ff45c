#include "surface/vtk_cells.h"

#include <utility>

#include <fmt/format.h>
#include <vtkCellType.h>

#include "core/errors.h"
#include "surface/counted.h"

namespace hexwall {

void VtkCells::add(int type, std::vector<int> corners) {
  switch (type) {
    case VTK_TRIANGLE:
    case VTK_QUAD:
    case VTK_POLYGON:
      polygons_.push_back(std::move(corners));
      break;
    case VTK_PIXEL:
      if (corners.size() != 4) {
        throw ReadError(fmt::format("cell {} is a pixel of {} corners", cells_, corners.size()));
      }
      polygons_.push_back({corners[0], corners[1], corners[3], corners[2]});
      break;
    case VTK_TRIANGLE_STRIP:
      add_strip(corners);
      break;
    case VTK_EMPTY_CELL:
    case VTK_VERTEX:
    case VTK_POLY_VERTEX:
    case VTK_LINE:
    case VTK_POLY_LINE:
      ++lower_;
      break;
    default:
      ++higher_;
  }
  cell_of_polygon_.resize(polygons_.size(), cells_++);
}

void VtkCells::move_to(PolygonSoup& soup) {
  soup.polygons = std::move(polygons_);
  if (lower_ > 0) {
    soup.notes.push_back(
        counted(lower_, "vertex or line cell was ignored", "vertex and line cells were ignored"));
  }
  if (higher_ > 0) {
    soup.notes.push_back(counted(higher_, "volume or curved cell was ignored",
                                 "volume or curved cells were ignored"));
  }
}

// Every second triangle of a strip runs backwards.
void VtkCells::add_strip(const std::vector<int>& strip) {
  for (std::size_t k = 0; k + 2 < strip.size(); ++k) {
    if (k % 2 == 0) {
      polygons_.push_back({strip[k], strip[k + 1], strip[k + 2]});
    } else {
      polygons_.push_back({strip[k + 1], strip[k], strip[k + 2]});
    }
  }
}

}  // namespace hexwall
