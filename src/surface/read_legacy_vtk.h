#pragma once

#include <string>

#include "surface/polygon_soup.h"
#include "surface/vtk_cells.h"

namespace hexwall {

/// VTK's legacy format, text or binary, of all versions: polygonal data or an unstructured grid.
/// `content` is the whole file. Triangle strips are converted; vertex, line and volume cells are
/// left out with a note. Arrays of numbers are kept, those of the wrong length or of words are not.
/// VTK's own reader is of no use here: it believes what a file says of its sizes and crashes.
/// Source: "VTK File Formats" in the VTK User's Guide, and vtkDataReader for what that leaves out.
/// \throws ReadError if the file is not of the format or truncated.
PolygonSoup parse_legacy_vtk(const std::string& content);

/// The same with all cells as they stand, without arrays.
VtkGrid parse_legacy_vtk_grid(const std::string& content);

}  // namespace hexwall
