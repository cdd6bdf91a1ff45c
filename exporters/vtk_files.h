#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <variant>
#include <vector>

#include "hex/cell_mesh.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// Named values on the points or cells of a mesh, in the mesh's order: `components` per element.
struct DataArray {
  std::string name;
  int components = 1;
  std::variant<std::vector<double>, std::vector<float>, std::vector<int>> values;
};

/// A named list of texts that belongs to a file as a whole.
struct FieldStrings {
  std::string name;
  std::vector<std::string> values;
};

/// Cells of one kind, each a list of point indices. All lists lie in one flat array.
class CellList {
 public:
  /// Appends the cell with the points `[first, last)`.
  template <typename Iterator>
  void add(Iterator first, Iterator last) {
    connectivity_.insert(connectivity_.end(), first, last);
    offsets_.push_back(static_cast<int>(connectivity_.size()));
  }
  /// Appends one cell with the points of a container such as `std::array<int, 4>`.
  template <typename Points>
  void add(const Points& points) {
    add(points.begin(), points.end());
  }
  void reserve(std::size_t cells, std::size_t points_per_cell);
  std::size_t size() const { return offsets_.size() - 1; }
  const std::vector<int>& connectivity() const { return connectivity_; }
  /// #cells + 1: cell i is `connectivity()[offsets()[i] .. offsets()[i + 1])`.
  const std::vector<int>& offsets() const { return offsets_; }

 private:
  std::vector<int> connectivity_;
  std::vector<int> offsets_{0};
};

/// Points, lines and polygons with data, as in a VTP file.
struct PolyData {
  std::vector<Vec3> points;
  CellList vertices;  ///< cells of one or more isolated points
  CellList lines;     ///< polylines of two or more points
  CellList polygons;
  std::vector<DataArray> point_arrays;
  std::vector<DataArray> cell_arrays;  ///< on the vertices, then the lines, then the polygons
  std::string texture_coordinates;     ///< name of the point array that is one; empty: none
  std::vector<FieldStrings> strings;
};

/// Writes a VTK XML poly data file (appended raw data, compressed). Same input, same bytes.
/// \throw WriteError if the file cannot be written; nothing half-written stays behind.
/// \throw Error(ExitCode::internal) if an array's length does not fit the mesh.
void write_vtp(const std::filesystem::path& path, const PolyData& data);

/// Writes a VTK XML unstructured grid with the given arrays and those of the mesh: `zone`,
/// `region`, `patch_of_face` (in the order of `faces_of` in hex/cell_faces.h), and the texts
/// `patch_names`, `zone_names` and `region_names`; exporters/README.md says what they mean. Lengths
/// are in the unit of `mesh`. Same input, same bytes. \throw WriteError if the file cannot be
/// written; nothing half-written stays behind. \throw Error(ExitCode::internal) if an array's
/// length does not fit the mesh, or the patches or zones do not.
void write_vtu(const std::filesystem::path& path, const CellMesh& mesh,
               const std::vector<DataArray>& cell_arrays = {},
               const std::vector<DataArray>& point_arrays = {});

/// The same into a stream that is at its beginning and allows to go back; see `ByteSource`.
void write_vtp(std::ostream& stream, const PolyData& data);
void write_vtu(std::ostream& stream, const CellMesh& mesh,
               const std::vector<DataArray>& cell_arrays = {},
               const std::vector<DataArray>& point_arrays = {});

}  // namespace hexwall
