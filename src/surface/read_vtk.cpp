#include "surface/read_vtk.h"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDataSetReader.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include "core/errors.h"
#include "surface/counted.h"
#include "surface/vtk_messages.h"

namespace hexwall {
namespace {

std::vector<int> corners_of(vtkIdList* ids) {
  std::vector<int> corners(ids->GetNumberOfIds());
  for (std::size_t k = 0; k < corners.size(); ++k) {
    corners[k] = static_cast<int>(ids->GetId(static_cast<vtkIdType>(k)));
  }
  return corners;
}

// Every second triangle of a strip runs backwards.
void add_strip(const std::vector<int>& strip, std::vector<std::vector<int>>& polygons) {
  for (std::size_t k = 0; k + 2 < strip.size(); ++k) {
    if (k % 2 == 0) {
      polygons.push_back({strip[k], strip[k + 1], strip[k + 2]});
    } else {
      polygons.push_back({strip[k + 1], strip[k], strip[k + 2]});
    }
  }
}

SurfaceArray values_of(vtkDataArray* array) {
  SurfaceArray result{array->GetName(), array->GetNumberOfComponents(), {}};
  result.values.reserve(array->GetNumberOfValues());
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
    for (int k = 0; k < result.components; ++k) {
      result.values.push_back(array->GetComponent(i, k));
    }
  }
  return result;
}

std::vector<SurfaceArray> arrays_of(vtkDataSetAttributes* data, vtkIdType tuples,
                                    std::vector<std::string>& notes) {
  std::vector<SurfaceArray> result;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    vtkDataArray* array = data->GetArray(i);  // null if it does not hold numbers
    if (array == nullptr || array->GetName() == nullptr || array->GetNumberOfComponents() < 1) {
      continue;
    }
    if (array->GetNumberOfTuples() != tuples) {
      notes.push_back(fmt::format("the array '{}' was ignored: it has {} tuples instead of {}",
                                  array->GetName(), array->GetNumberOfTuples(), tuples));
      continue;
    }
    result.push_back(values_of(array));
  }
  return result;
}

struct Ignored {
  int lower = 0;   ///< vertices and lines
  int higher = 0;  ///< volume cells, curved cells
};

void note_ignored(const Ignored& ignored, std::vector<std::string>& notes) {
  if (ignored.lower > 0) {
    notes.push_back(counted(ignored.lower, "vertex or line cell was ignored",
                            "vertex and line cells were ignored"));
  }
  if (ignored.higher > 0) {
    notes.push_back(counted(ignored.higher, "volume or curved cell was ignored",
                            "volume or curved cells were ignored"));
  }
}

void add_cell(vtkDataSet* data, vtkIdType cell, vtkIdList* ids, PolygonSoup& soup,
              Ignored& ignored) {
  data->GetCellPoints(cell, ids);
  std::vector<int> corners = corners_of(ids);
  switch (data->GetCellType(cell)) {
    case VTK_TRIANGLE:
    case VTK_QUAD:
    case VTK_POLYGON:
      soup.polygons.push_back(std::move(corners));
      break;
    case VTK_PIXEL:
      soup.polygons.push_back({corners[0], corners[1], corners[3], corners[2]});
      break;
    case VTK_TRIANGLE_STRIP:
      add_strip(corners, soup.polygons);
      break;
    case VTK_EMPTY_CELL:
    case VTK_VERTEX:
    case VTK_POLY_VERTEX:
    case VTK_LINE:
    case VTK_POLY_LINE:
      ++ignored.lower;
      break;
    default:
      ++ignored.higher;
  }
}

PolygonSoup soup_of(vtkDataSet* data) {
  PolygonSoup soup;
  soup.points.resize(data->GetNumberOfPoints());
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    data->GetPoint(static_cast<vtkIdType>(v), soup.points[v].data());
  }
  Ignored ignored;
  std::vector<int> cell_of_polygon;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell) {
    add_cell(data, cell, ids, soup, ignored);
    cell_of_polygon.resize(soup.polygons.size(), static_cast<int>(cell));
  }
  note_ignored(ignored, soup.notes);
  soup.point_arrays = arrays_of(data->GetPointData(), data->GetNumberOfPoints(), soup.notes);
  soup.polygon_arrays =
      follow(arrays_of(data->GetCellData(), data->GetNumberOfCells(), soup.notes), cell_of_polygon);
  return soup;
}

template <typename Reader>
PolygonSoup read_with(Reader* reader, const std::filesystem::path& path) {
  const VtkMessages messages;
  reader->SetFileName(path.c_str());
  reader->Update();
  if (!messages.error().empty()) throw ReadError(messages.error());
  vtkDataSet* data = reader->GetOutput();
  if (data == nullptr) throw ReadError("the file holds no data that VTK can read");
  return soup_of(data);
}

}  // namespace

PolygonSoup read_vtp(const std::filesystem::path& path) {
  vtkNew<vtkXMLPolyDataReader> reader;
  return read_with(reader.Get(), path);
}

PolygonSoup read_legacy_vtk(const std::filesystem::path& path) {
  vtkNew<vtkDataSetReader> reader;
  // Of each kind of array it reads only the first one unless told otherwise.
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllNormalsOn();
  reader->ReadAllTensorsOn();
  reader->ReadAllColorScalarsOn();
  reader->ReadAllTCoordsOn();
  reader->ReadAllFieldsOn();
  return read_with(reader.Get(), path);
}

}  // namespace hexwall
