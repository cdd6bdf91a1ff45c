#include "exporters/svmultiphysics.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "pipeline.h"
#include "support/block_mesh.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"
#include "surface/generate.h"

namespace hexwall::test {
namespace {

template <typename Reader>
auto read_vtk(const std::filesystem::path& path) {
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  using Output = std::remove_pointer_t<decltype(reader->GetOutput())>;
  return vtkSmartPointer<Output>(reader->GetOutput());
}

/// The solver takes nothing but 32-bit integers.
std::vector<int> ints(vtkFieldData* data, const char* name) {
  auto* array = vtkIntArray::SafeDownCast(data->GetAbstractArray(name));
  EXPECT_NE(array, nullptr) << name;
  if (array == nullptr) return {};
  return {array->Begin(), array->End()};
}

Vec3 point_of(vtkDataSet* data, vtkIdType i) {
  return Vec3(data->GetPoint(i));
}

std::vector<int> cell_of(vtkDataSet* data, vtkIdType i) {
  vtkNew<vtkIdList> ids;
  data->GetCellPoints(i, ids);
  return {ids->begin(), ids->end()};
}

using Face = std::vector<int>;

/// Faces in vertices of the volume mesh, from the smallest one on, with the hex and the patch.
struct Surface {
  std::map<Face, int> hex_of;
  std::map<Face, int> patch_of;
};

class SvMultiPhysics : public testing::Test {
 protected:
  explicit SvMultiPhysics(HexMesh mesh = block_mesh({})) : mesh_(std::move(mesh)) {
    write_svmultiphysics(folder_ / "mesh-complete", mesh_);
    volume_ = read_vtk<vtkXMLUnstructuredGridReader>(file("mesh-complete.mesh.vtu"));
  }

  std::filesystem::path file(const std::string& name) const {
    return folder_ / "mesh-complete" / name;
  }

  /// Reads a surface and checks that its points are those of the volume that it names.
  Surface read_surface(const std::string& name) const {
    const auto data = read_vtk<vtkXMLPolyDataReader>(file(name));
    const std::vector<int> nodes = ints(data->GetPointData(), "GlobalNodeID");
    const std::vector<int> hexes = ints(data->GetCellData(), "GlobalElementID");
    const std::vector<int> patches = ints(data->GetCellData(), "ModelFaceID");
    EXPECT_EQ(std::set<int>(nodes.begin(), nodes.end()).size(), nodes.size()) << "points twice";
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
      EXPECT_EQ(point_of(data, i), point_of(volume_, nodes.at(i) - 1));
    Surface surface;
    for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) {
      Face face = cell_of(data, i);
      for (int& v : face) v = nodes.at(v) - 1;
      expect_outward(face, hexes.at(i) - 1);
      std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
      EXPECT_TRUE(surface.hex_of.emplace(face, hexes.at(i) - 1).second) << "a face twice";
      surface.patch_of[face] = patches.at(i) - 1;
    }
    return surface;
  }

  /// The face has four vertices of the hex, and its normal points away from the hex' centre.
  void expect_outward(const Face& face, int hex) const {
    const std::vector<int> corners = cell_of(volume_, hex);
    ASSERT_EQ(face.size(), 4U);
    Vec3 middle = Vec3::Zero(), centre = Vec3::Zero();
    for (const int v : corners) centre += point_of(volume_, v) / 8;
    for (const int v : face) {
      middle += point_of(volume_, v) / 4;
      ASSERT_TRUE(std::find(corners.begin(), corners.end(), v) != corners.end());
    }
    const Vec3 diagonal_1 = point_of(volume_, face[2]) - point_of(volume_, face[0]);
    const Vec3 diagonal_2 = point_of(volume_, face[3]) - point_of(volume_, face[1]);
    EXPECT_GT(diagonal_1.cross(diagonal_2).dot(middle - centre), 0);
  }

  Surface expected(const std::function<bool(const CellPatch&)>& is_wanted) const {
    Surface surface;
    for (std::size_t p = 0; p < mesh_.patches.size(); ++p) {
      if (!is_wanted(mesh_.patches[p])) continue;
      for (const CellFace& f : mesh_.patches[p].faces) {
        Face face(f.vertices.begin(), f.vertices.end());
        std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
        surface.hex_of[face] = f.cell;
        surface.patch_of[face] = static_cast<int>(p);
      }
    }
    return surface;
  }

  void expect_surface(const std::string& name,
                      const std::function<bool(const CellPatch&)>& is_wanted) const {
    const Surface surface = read_surface(name);
    const Surface wanted = expected(is_wanted);
    EXPECT_FALSE(wanted.hex_of.empty());
    EXPECT_EQ(surface.hex_of, wanted.hex_of) << name;
    EXPECT_EQ(surface.patch_of, wanted.patch_of) << name;
  }

  void expect_all_surfaces() const {
    for (const CellPatch& patch : mesh_.patches)
      expect_surface("mesh-surfaces/" + patch.name + ".vtp",
                     [&](const CellPatch& p) { return p.name == patch.name; });
    expect_surface("mesh-complete.exterior.vtp", [](const CellPatch&) { return true; });
    expect_surface("walls_combined.vtp", [](const CellPatch& p) { return p.is_wall; });
  }

  TemporaryFolder folder_;
  HexMesh mesh_;
  vtkSmartPointer<vtkUnstructuredGrid> volume_;
};

TEST_F(SvMultiPhysics, VolumeIsNumberedFromOne) {
  ASSERT_EQ(volume_->GetNumberOfCells(), static_cast<vtkIdType>(mesh_.shape.size()));
  const auto nodes = ints(volume_->GetPointData(), "GlobalNodeID");
  const auto elements = ints(volume_->GetCellData(), "GlobalElementID");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    EXPECT_EQ(nodes[i], static_cast<int>(i) + 1);
    EXPECT_EQ(point_of(volume_, static_cast<vtkIdType>(i)), mesh_.points.at(i));
  }
  for (std::size_t i = 0; i < elements.size(); ++i) {
    EXPECT_EQ(elements[i], static_cast<int>(i) + 1);
    const auto hex = mesh_.corners(static_cast<int>(i));
    EXPECT_EQ(cell_of(volume_, static_cast<vtkIdType>(i)),
              std::vector<int>(hex.begin(), hex.end()));
  }
}

TEST_F(SvMultiPhysics, ZonesAreRegionsAndDomains) {
  const auto regions = ints(volume_->GetCellData(), "ModelRegionID");
  ASSERT_EQ(regions.size(), mesh_.shape.size());
  for (std::size_t z = 0; z < mesh_.zones.size(); ++z)
    for (const int hex : mesh_.zones[z].cells) EXPECT_EQ(regions[hex], static_cast<int>(z) + 1);
  std::istringstream file(bytes_of(this->file("domain_ids.dat")));
  std::vector<int> domains;
  for (int domain; file >> domain;) domains.push_back(domain);
  EXPECT_EQ(domains, regions);
}

TEST_F(SvMultiPhysics, SurfacesAreThePatches) {
  expect_all_surfaces();
}

class SvMultiPhysicsOfVessel : public SvMultiPhysics {
 protected:
  SvMultiPhysicsOfVessel() : SvMultiPhysics(bifurcation_wall()) {}
  static HexMesh bifurcation_wall() {
    PipelineOptions options;
    options.size = 0.3;
    return run_pipeline(generate_shape(Shape::bifurcation, 0.25), options).wall;
  }
};

TEST_F(SvMultiPhysicsOfVessel, SurfacesAreThePatches) {
  expect_all_surfaces();
}

TEST(SvMultiPhysicsFiles, EmptyPatchesAreLeftOut) {
  const TemporaryFolder folder;
  HexMesh mesh = block_mesh({});
  for (CellPatch& patch : mesh.patches) patch.is_wall = false;
  mesh.patches.push_back({"nothing", true, {}});
  write_svmultiphysics(folder.path(), mesh);
  EXPECT_TRUE(std::filesystem::exists(folder / "mesh-surfaces/loop_1.vtp"));
  EXPECT_FALSE(std::filesystem::exists(folder / "mesh-surfaces/nothing.vtp"));
  EXPECT_FALSE(std::filesystem::exists(folder / "walls_combined.vtp"));
}

TEST(SvMultiPhysicsFiles, RefuseNamesThatAreNoFiles) {
  for (const char* name : {"", "..", "a/b"}) {
    const TemporaryFolder folder;
    HexMesh mesh = block_mesh({});
    mesh.patches[2].name = name;
    expect_error(ExitCode::internal, {"no name of a file"},
                 [&] { write_svmultiphysics(folder / "out", mesh); });
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  }
}

}  // namespace
}  // namespace hexwall::test
