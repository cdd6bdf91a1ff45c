#include "exporters/vtk_files.h"

#include <ostream>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "core/errors.h"
#include "exporters/output_file.h"
#include "exporters/zlib_compressor.h"
#include "hex/cell_faces.h"

namespace hexwall {
namespace {

template <typename T>
struct VtkArrayOf;
template <>
struct VtkArrayOf<double> {
  using Type = vtkDoubleArray;
};
template <>
struct VtkArrayOf<float> {
  using Type = vtkFloatArray;
};
template <>
struct VtkArrayOf<int> {
  using Type = vtkIntArray;
};
template <>
struct VtkArrayOf<unsigned char> {
  using Type = vtkUnsignedCharArray;
};

// VTK uses the values where they are: they must stay there until the file is written.
template <typename T>
auto to_vtk(const T* values, std::size_t count, int components) {
  auto array = vtkSmartPointer<typename VtkArrayOf<T>::Type>::New();
  array->SetNumberOfComponents(components);
  constexpr int caller_keeps_it = 1;
  array->SetArray(const_cast<T*>(values), static_cast<vtkIdType>(count), caller_keeps_it);
  return array;
}

vtkSmartPointer<vtkDataArray> to_vtk(const DataArray& data) {
  vtkSmartPointer<vtkDataArray> array = std::visit(
      [&](const auto& values) -> vtkSmartPointer<vtkDataArray> {
        return to_vtk(values.data(), values.size(), data.components);
      },
      data.values);
  array->SetName(data.name.c_str());
  return array;
}

vtkSmartPointer<vtkPoints> to_vtk(const std::vector<Vec3>& points) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  auto result = vtkSmartPointer<vtkPoints>::New();
  const double* coordinates = points.empty() ? nullptr : points.front().data();
  result->SetData(to_vtk(coordinates, 3 * points.size(), 3));
  return result;
}

vtkSmartPointer<vtkCellArray> to_vtk(const CellList& cells) {
  auto result = vtkSmartPointer<vtkCellArray>::New();
  result->SetData(to_vtk(cells.offsets().data(), cells.offsets().size(), 1).Get(),
                  to_vtk(cells.connectivity().data(), cells.connectivity().size(), 1).Get());
  return result;
}

vtkSmartPointer<vtkDataArray> to_vtk(const CellFaceValues& values, const char* name) {
  const int* first = values.empty() ? nullptr : values.front().data();
  vtkSmartPointer<vtkDataArray> array = to_vtk(first, 6 * values.size(), 6);
  array->SetName(name);
  return array;
}

void add_array(vtkDataSetAttributes* target, const DataArray& array, std::size_t elements) {
  const std::size_t size = std::visit([](const auto& v) { return v.size(); }, array.values);
  if (array.components < 1 || size != elements * static_cast<std::size_t>(array.components))
    throw Error(ExitCode::internal, "array " + array.name + " has " + std::to_string(size) +
                                        " values for " + std::to_string(elements) + " elements");
  target->AddArray(to_vtk(array));
}

void add_arrays(vtkDataSetAttributes* target, const std::vector<DataArray>& arrays,
                std::size_t elements) {
  for (const DataArray& array : arrays) add_array(target, array, elements);
}

void add_strings(vtkDataSet* target, const FieldStrings& strings) {
  vtkNew<vtkStringArray> array;
  array->SetName(strings.name.c_str());
  for (const std::string& value : strings.values) array->InsertNextValue(value);
  target->GetFieldData()->AddArray(array);
}

/// VTK's writers can write into a stream that is there already, but let no one but their heirs set
/// it.
template <typename Writer>
class StreamWriter : public Writer {
 public:
  static StreamWriter* New() {
    auto* writer = new StreamWriter;
    writer->InitializeObjectBase();
    return writer;
  }
  void set_stream(std::ostream& stream) { this->Stream = &stream; }
};

template <typename Writer>
void write_xml(std::ostream& stream, vtkDataSet* data) {
  vtkNew<StreamWriter<Writer>> writer;
  writer->set_stream(stream);
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetHeaderTypeToUInt64();
  // LZ4 gives files of twice the size, and meshio cannot read it.
  vtkNew<ZlibCompressor> compressor;
  compressor->SetCompressionLevel(1);
  writer->SetCompressor(compressor);
  writer->SetBlockSize(std::size_t{256} << 10);
  writer->Write();
}

template <typename Named>
FieldStrings names_of(const std::string& name, const std::vector<Named>& list) {
  FieldStrings names{name, {}};
  for (const Named& item : list) names.values.push_back(item.name);
  return names;
}

void set_cells(vtkUnstructuredGrid* grid, const CellMesh& mesh) {
  static_assert(sizeof(CellShape) == sizeof(unsigned char));
  const auto* shapes = reinterpret_cast<const unsigned char*>(mesh.shape.data());
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(to_vtk(mesh.offset.data(), mesh.offset.size(), 1).Get(),
                 to_vtk(mesh.connectivity.data(), mesh.connectivity.size(), 1).Get());
  grid->SetCells(to_vtk(shapes, mesh.shape.size(), 1), cells);
}

void add_names(vtkUnstructuredGrid* grid, const CellMesh& mesh) {
  add_strings(grid, names_of("patch_names", mesh.patches));
  add_strings(grid, names_of("zone_names", mesh.zones));
  add_strings(grid, names_of("region_names", mesh.regions));
}

}  // namespace

void CellList::reserve(std::size_t cells, std::size_t points_per_cell) {
  offsets_.reserve(cells + 1);
  connectivity_.reserve(cells * points_per_cell);
}

void write_vtp(std::ostream& stream, const PolyData& data) {
  vtkNew<vtkPolyData> poly;
  poly->SetPoints(to_vtk(data.points));
  poly->SetVerts(to_vtk(data.vertices));
  poly->SetLines(to_vtk(data.lines));
  poly->SetPolys(to_vtk(data.polygons));
  const std::size_t cells = data.vertices.size() + data.lines.size() + data.polygons.size();
  add_arrays(poly->GetPointData(), data.point_arrays, data.points.size());
  add_arrays(poly->GetCellData(), data.cell_arrays, cells);
  if (!data.texture_coordinates.empty() &&
      poly->GetPointData()->SetActiveTCoords(data.texture_coordinates.c_str()) < 0)
    throw Error(ExitCode::internal, "no point array " + data.texture_coordinates);
  for (const FieldStrings& strings : data.strings) add_strings(poly, strings);
  write_xml<vtkXMLPolyDataWriter>(stream, poly);
}

void write_vtu(std::ostream& stream, const CellMesh& mesh,
               const std::vector<DataArray>& cell_arrays,
               const std::vector<DataArray>& point_arrays) {
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(to_vtk(mesh.points));
  set_cells(grid, mesh);
  const std::vector<DataArray> groups{{"zone", 1, group_of_cells(mesh, mesh.zones)},
                                      {"region", 1, group_of_cells(mesh, mesh.regions)}};
  const CellFaceValues patches = patch_of_faces(mesh);
  add_arrays(grid->GetCellData(), groups, mesh.shape.size());
  grid->GetCellData()->AddArray(to_vtk(patches, "patch_of_face"));
  add_names(grid, mesh);
  add_arrays(grid->GetCellData(), cell_arrays, mesh.shape.size());
  add_arrays(grid->GetPointData(), point_arrays, mesh.points.size());
  write_xml<vtkXMLUnstructuredGridWriter>(stream, grid);
}

void write_vtp(const std::filesystem::path& path, const PolyData& data) {
  write_output_file(path, [&](std::ostream& stream) { write_vtp(stream, data); });
}

void write_vtu(const std::filesystem::path& path, const CellMesh& mesh,
               const std::vector<DataArray>& cell_arrays,
               const std::vector<DataArray>& point_arrays) {
  write_output_file(
      path, [&](std::ostream& stream) { write_vtu(stream, mesh, cell_arrays, point_arrays); });
}

}  // namespace hexwall
