#include "support/result_files.h"

#include <algorithm>
#include <stdexcept>

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "support/temporary_folder.h"

namespace hexwall::test {
namespace {

/// Faces of VTK_HEXAHEDRON, counter-clockwise from outside.
constexpr std::array<std::array<int, 4>, 6> hex_faces{
    {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};

Points points_of(vtkPointSet* data) {
  Points points;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    points.emplace_back(data->GetPoint(i)[0], data->GetPoint(i)[1], data->GetPoint(i)[2]);
  }
  return points;
}

/// The corners of all cells, each of which has to have n.
template <std::size_t n>
std::vector<std::array<int, n>> cells_of(vtkDataSet* data) {
  std::vector<std::array<int, n>> cells(data->GetNumberOfCells());
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) {
    data->GetCellPoints(i, corners);
    if (corners->GetNumberOfIds() != n) throw std::runtime_error("a cell of another kind");
    std::copy(corners->begin(), corners->end(), cells[i].begin());
  }
  return cells;
}

template <typename Reader>
void read(Reader& reader, const std::filesystem::path& path) {
  if (reader.CanReadFile(path.c_str()) == 0) throw std::runtime_error("not read: " + path.string());
  reader.SetFileName(path.c_str());
  reader.Update();
}

std::vector<std::string> strings_of(vtkDataSet* data, const char* name) {
  auto* array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
  if (array == nullptr) throw std::runtime_error(std::string("there is no ") + name);
  std::vector<std::string> values;
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i) values.push_back(array->GetValue(i));
  return values;
}

void read_patches(vtkDataArray* patch_of_face, HexFile& file) {
  if (patch_of_face == nullptr) throw std::runtime_error("there is no patch_of_face");
  file.patches.resize(file.patch_names.size());
  for (std::size_t h = 0; h < file.hexes.size(); ++h) {
    for (int f = 0; f < 6; ++f) {
      const auto patch =
          static_cast<int>(patch_of_face->GetComponent(static_cast<vtkIdType>(h), f));
      if (patch < 0) continue;
      std::array<int, 4> face;
      for (int k = 0; k < 4; ++k) face[k] = file.hexes[h][hex_faces[f][k]];
      file.patches.at(patch).push_back(face);
    }
  }
}

void expect_valid_hexes(const HexFile& file, const nlohmann::json& report) {
  const HexVerdict verdict = verify_hexes(file.points, file.hexes, file.patches);
  EXPECT_TRUE(verdict.faults.none()) << verdict.faults.text();
  EXPECT_GT(verdict.min_scaled_jacobian, 0.0);
  const auto& wall = report["wall"];
  EXPECT_NEAR(verdict.min_scaled_jacobian, wall["min_scaled_jacobian"].get<double>(), 1e-9);
  EXPECT_NEAR(verdict.hex_volume, verdict.boundary_volume, 1e-9 * verdict.hex_volume);
  EXPECT_EQ(file.hexes.size(), wall["hexes"].get<std::size_t>());
  const auto& openings = report["input"]["openings"];
  ASSERT_EQ(file.patch_names.size(), 2 + openings.size());
  for (std::size_t i = 0; i < openings.size(); ++i) {
    EXPECT_EQ(file.patch_names[i + 2], openings[i]["name"]);
    EXPECT_FALSE(file.patches[i + 2].empty()) << openings[i]["name"];
  }
}

void expect_valid_quads(const QuadFile& file, const nlohmann::json& report) {
  const QuadVerdict verdict = verify_quads(static_cast<int>(file.points.size()), file.quads);
  ASSERT_TRUE(verdict.faults.none()) << verdict.faults.text();
  const auto openings = report["input"]["openings"].size();
  EXPECT_EQ(verdict.components, 1);
  EXPECT_EQ(static_cast<std::size_t>(verdict.boundary_loops), openings);
  EXPECT_EQ(verdict.euler_number, 2 - static_cast<int>(openings));
  int irregular = 0;
  for (std::size_t v = 0; v < verdict.valence.size(); ++v) {
    if (verdict.on_boundary[v] == 0 && verdict.valence[v] != 4) ++irregular;
  }
  EXPECT_EQ(irregular, report["quads"]["irregular"].get<int>());
  EXPECT_EQ(file.quads.size(), report["quads"]["count"].get<std::size_t>());
}

}  // namespace

HexFile read_hex_file(const std::filesystem::path& path) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  read(*reader, path);
  vtkUnstructuredGrid* grid = reader->GetOutput();
  HexFile file{points_of(grid), cells_of<8>(grid), strings_of(grid, "patch_names"), {}};
  read_patches(grid->GetCellData()->GetArray("patch_of_face"), file);
  return file;
}

QuadFile read_quad_file(const std::filesystem::path& path) {
  vtkNew<vtkXMLPolyDataReader> reader;
  read(*reader, path);
  return {points_of(reader->GetOutput()), cells_of<4>(reader->GetOutput())};
}

nlohmann::json report_in(const std::filesystem::path& folder) {
  return nlohmann::json::parse(bytes_of(folder / "report.json"));
}

MeshCounts counts_of(const nlohmann::json& report) {
  return {static_cast<int>(report["input"]["openings"].size()),
          static_cast<int>(report["poles"].size()), report["zeros"]["total_order"].get<double>(),
          report["zeros"]["boundary_halves"].get<int>(), report["quads"]["irregular"].get<int>()};
}

void expect_valid_results(const std::filesystem::path& folder) {
  const nlohmann::json report = report_in(folder);
  expect_valid_hexes(read_hex_file(folder / "wall.vtu"), report);
  expect_valid_quads(read_quad_file(folder / "quads.vtp"), report);
}

}  // namespace hexwall::test
