// Readers of meshes: what they make of sound files, and what they say of others.

#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "inspect/face_mesh.h"
#include "inspect/read_mesh.h"
#include "inspect/small_meshes.h"
#include "support/child_process.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace hexwall::test {
namespace {

constexpr double eps = 1e-12;

class Readers : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    const auto path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
    return path.string();
  }

  void expect_unreadable(const std::string& name, const std::string& text,
                         std::initializer_list<const char*> words) const {
    const std::string path = file(name, text);
    expect_error(ExitCode::read, words, [&] { read_mesh(path); });
  }

  TemporaryFolder folder_;
};

// A cube, a wedge on its right side, a pyramid on its top, a tetrahedron on the pyramid's front,
// and a quad at the bottom.
constexpr const char* gmsh_nodes =
    "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n"
    "9 2 0 0\n10 2 1 0\n21 0.5 0.5 2\n22 0.5 -1 2\n";

void expect_all_shapes(const AnyMesh& mesh) {
  const MeshQuality q = mesh_quality(mesh);
  for (const ElementShape shape : {ElementShape::tetrahedron, ElementShape::pyramid,
                                   ElementShape::wedge, ElementShape::hexahedron}) {
    EXPECT_EQ(q.count[static_cast<std::size_t>(shape)], 1U) << name(shape);
  }
  EXPECT_EQ(mesh.points.size(), 12U);
  // 1 + 1/2 + 1/3 + 1/6 |(e1, e2, e3)| with edges (1,0,0), (.5,.5,1), (.5,-1,1): 1.5 / 6.
  const Distribution& volume = metric(q, "volume");
  EXPECT_NEAR(volume.mean * static_cast<double>(volume.count), 1.0 + 0.5 + 1.0 / 3.0 + 0.25, eps);
  EXPECT_GT(volume.min, 0.0);
  EXPECT_EQ(foam(q, "nonOrthoAngle").count, 3U);  // all are joined
  EXPECT_NEAR(foam(q, "cellOpenness").max, 0.0, eps);
}

TEST_F(Readers, Gmsh2) {
  const std::string path = file(
      "a.msh", std::string("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"x\"\n"
                           "$EndPhysicalNames\n$Nodes\n12\n") +
                   gmsh_nodes +
                   "$EndNodes\n$Elements\n7\n1 15 2 0 1 1\n2 1 2 0 1 1 2\n3 3 2 0 1 1 4 3 2\n"
                   "4 5 2 0 1 1 2 3 4 5 6 7 8\n5 6 2 0 1 3 10 7 2 9 6\n6 7 2 0 1 5 6 7 8 21\n"
                   "7 4 2 0 1 5 22 6 21\n$EndElements\n");
  const AnyMesh mesh = read_mesh(path);
  expect_all_shapes(mesh);
  EXPECT_EQ(mesh.label, (std::vector<std::int64_t>{3, 4, 5, 6, 7}));
  EXPECT_EQ(mesh.notes, std::vector<std::string>{"2 point and line elements were ignored"});
}

TEST_F(Readers, Abaqus) {
  const std::string path = file(
      "a.INP",
      "*HEADING\n anything\n** a comment\n*Node, NSET=all\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n"
      "5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n9,2\n10,2,1\n21,.5,.5,2\n22,.5,-1.,2e0\n"
      "*NSET, NSET=some\n1, 2\n*ELEMENT, type=C3D8R, ELSET=e\n10, 1,2,3,4,\n 5,6,7,8\n"
      "*Element,TYPE = C3D6\n11, 3,10,7,2,9,6\n*ELEMENT, TYPE=C3D5\n12, 5,6,7,8,21\n"
      "*ELEMENT, TYPE=C3D4\n13, 5, 22, 6, 21\n*ELEMENT, TYPE=T3D2\n14, 1, 2\n*STEP\n");
  const AnyMesh mesh = read_mesh(path);
  expect_all_shapes(mesh);
  EXPECT_EQ(mesh.label, (std::vector<std::int64_t>{10, 11, 12, 13}));
  EXPECT_EQ(mesh.notes, std::vector<std::string>{"1 element of an unknown kind was ignored"});
}

constexpr const char* vtk_points =
    "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1 2 0 0 2 1 0 .5 .5 2 .5 -1 2\n";

TEST_F(Readers, LegacyVtk) {
  const std::string path =
      file("a.vtk", std::string("# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                                "POINTS 12 double\n") +
                        vtk_points +
                        "CELLS 4 27\n8 0 1 3 2 4 5 7 6\n6 2 9 6 1 8 5\n5 4 5 6 7 10\n"
                        "4 4 11 5 10\nCELL_TYPES 4\n11 13 14 10\n");
  expect_all_shapes(read_mesh(path));  // the cube is a voxel here
}

std::string vtu(const std::string& cells) {
  return std::string(
             "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" "
             "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece "
             "NumberOfPoints=\"12\" NumberOfCells=\"4\">\n<Points><DataArray "
             "type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n") +
         vtk_points + "</DataArray></Points>\n<Cells>" + cells +
         "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

std::string array(const std::string& name, const std::string& numbers) {
  return "<DataArray type=\"Int64\" Name=\"" + name + "\" format=\"ascii\">" + numbers +
         "</DataArray>\n";
}

// VTK documents the wedge with its first triangle looking away from the second.
TEST_F(Readers, VtuWithAWedgeInTheOtherOrder) {
  const AnyMesh mesh = read_mesh(
      file("a.vtu", vtu(array("connectivity", "0 1 2 3 4 5 6 7 1 8 5 2 9 6 4 5 6 7 10 4 11 5 10") +
                        array("offsets", "8 14 19 23") + array("types", "12 13 14 10"))));
  expect_all_shapes(mesh);
  EXPECT_EQ(mesh.notes.size(), 1U);
}

TEST_F(Readers, VtuWithAPolyhedron) {
  const AnyMesh mesh = read_mesh(
      file("a.vtu", vtu(array("connectivity", "0 1 2 3 4 5 6 7 1 8 5 2 9 6 4 5 6 7 10 4 11 5 10") +
                        array("offsets", "8 14 19 23") + array("types", "12 13 42 10") +
                        array("faces", "5 4 4 7 6 5 3 4 5 10 3 5 6 10 3 6 7 10 3 7 4 10") +
                        array("faceoffsets", "-1 -1 22 -1"))));
  const MeshQuality q = mesh_quality(mesh);
  EXPECT_EQ(q.count[static_cast<std::size_t>(ElementShape::polyhedron)], 1U);
  const FoamMetric& volume = foam(q, "cellVolume");
  EXPECT_NEAR(volume.mean * 4.0, 1.0 + 0.5 + 1.0 / 3.0 + 0.25, eps);
  EXPECT_EQ(foam(q, "nonOrthoAngle").count, 3U);
}

std::string foam_file(const std::string& body) {
  return "/* a banner\n * of lines */\nFoamFile\n{\n    version 2.0;\n    format ascii;\n    note "
         "\"a } brace\";\n}\n// * * //\n\n" +
         body;
}

// Two cubes, the second with a side face in two halves: a polyhedron.
class FoamReader : public Readers {
 protected:
  FoamReader() {
    write("points", foam_file("14((0 0 0)(1 0 0)(1 1 0)(0 1 0)(0 0 1)(1 0 1)(1 1 1)(0 1 1)\n"
                              "(0 0 2)(1 0 2)(1 1 2)(0 1 2)(.5 0 1)(.5 0 2))"));
    write("faces", foam_file("13\n(\n5(4 12 5 6 7)\n4(0 3 2 1)\n5(0 1 5 12 4)\n4(1 2 6 5)\n"
                             "4(2 3 7 6)\n4(3 0 4 7)\n5(8 13 9 10 11)\n4(4 12 13 8)\n"
                             "4(12 5 9 13)\n4(5 6 10 9)\n4(6 7 11 10)\n4(7 4 8 11)\n3(0 0 0)\n)"));
    write("owner", foam_file("12(0 0 0 0 0 0 1 1 1 1 1 1)"));
    write("neighbour", foam_file("1{1}"));
  }

  void write(const std::string& name, const std::string& text) const {
    file("case/constant/polyMesh/" + name, text);
  }
  void expect_refused(std::initializer_list<const char*> words) const {
    expect_error(ExitCode::read, words, [&] { read_mesh(folder_ / "case"); });
  }
  void drop_thirteenth_face() const {
    std::string faces = bytes_of(folder_ / "case/constant/polyMesh/faces");
    faces.replace(faces.find("13\n("), 2, "12");
    faces.erase(faces.find("3(0 0 0)"), 9);
    write("faces", faces);
  }
};

TEST_F(FoamReader, KnowsCellsByTheirFaces) {
  drop_thirteenth_face();
  for (const char* below : {"case", "case/constant", "case/constant/polyMesh"}) {
    const AnyMesh mesh = read_mesh(folder_ / below);
    EXPECT_EQ(mesh.shape, (std::vector{ElementShape::polyhedron, ElementShape::polyhedron}));
    const MeshQuality q = mesh_quality(mesh);
    EXPECT_NEAR(foam(q, "cellVolume").min, 1.0, eps);
    EXPECT_NEAR(foam(q, "cellVolume").max, 1.0, eps);
    EXPECT_NEAR(foam(q, "nonOrthoAngle").max, 0.0, 1e-6);
  }
}

TEST_F(FoamReader, SaysWhatIsWrong) {
  expect_refused({"case", "13 faces, but 12 owners"});
  write("owner", foam_file("13(0 0 0 0 0 0 1 1 1 1 1 1 x)"));
  expect_refused({"owner: line 11: 'x' is not a number"});
  write("owner", foam_file("13(0 0 0 0 0 0 1 1 1 1 1 1 3)"));
  expect_refused({"cell 2 has 0 faces"});
  write("owner", foam_file("13(0 0 0 0 0 0 1 1 1 1 1 1 99)"));
  expect_refused({"cell 99 of 13 faces"});
  write("owner", foam_file("2000000000{0}"));
  expect_refused({"owner: line 11: 2000000000 labels of 13 faces"});
  write("faces", foam_file("13\n(\n4(0 1 2 99)"));
  expect_refused({"faces: line 13: the file is truncated"});
  write("faces", "FoamFile { format binary; }\n");
  expect_refused({"faces: line 1: the mesh is binary", "foamFormatConvert"});
  std::filesystem::remove(folder_ / "case/constant/polyMesh/faces");
  expect_refused({"the folder holds no OpenFOAM mesh"});
  file("case/constant/polyMesh/faces.gz", "");
  expect_refused({"faces: the file is compressed: unpack it with gunzip"});
}

TEST_F(Readers, SayInWhichLineAFileIsWrong) {
  const std::string head = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  expect_unreadable("a.msh", "$Nodes\n0\n", {"a.msh", "line 1", "$MeshFormat"});
  expect_unreadable("a.msh", "$MeshFormat\n4.1 1 8\n", {"line 2", "binary"});
  expect_unreadable("a.msh", "$MeshFormat\n3.0 0 8\n", {"line 2", "version 3.0"});
  expect_unreadable("a.msh", head + "$Nodes\n1 1 1 1\n2 1 0 1\n1\n0 0\n", {"line 8", "3 coord"});
  expect_unreadable("a.msh", head + "$Nodes\n1 9 1 9\n2 1 0 9\n1\n0 0\n", {"line 8", "truncated"});
  expect_unreadable("a.msh",
                    head +
                        "$Nodes\n1 1 1 1\n2 1 0 1\n1\n0 0 0\n$EndNodes\n$Elements\n"
                        "1 1 1 1\n2 1 2 1\n1 1 1 2\n$EndElements\n",
                    {"line 13", "element 1 refers to node 2, which is not there"});
  expect_unreadable("a.msh",
                    head +
                        "$Nodes\n1 1 1 1\n2 1 0 1\n1\n0 0 0\n$EndNodes\n$Elements\n"
                        "1 1 1 1\n2 1 5 1\n1 1 1 1\n$EndElements\n",
                    {"line 13", "element 1 of type 5 has only 3 nodes"});
  expect_unreadable("a.msh", head, {"there are no cells"});
  expect_unreadable("a.inp", "*NODE\n1, 0, zero, 0\n", {"a.inp", "line 2", "'zero'"});
  expect_unreadable("a.inp", "*NODE\n1,0,0,0\n*ELEMENT\n", {"line 3", "no TYPE"});
  expect_unreadable("a.inp", "*NODE\n1,0,0,0\n*ELEMENT, TYPE=S3\n1, 1, 1, 2\n",
                    {"line 4", "element 1 refers to node 2"});
  expect_unreadable("a.inp", "*NODE\n1,0,0,0\n*ELEMENT, TYPE=S3\n1, 1, 1\n",
                    {"line 4", "element 1 of type S3 has only 2 nodes"});
  expect_unreadable("a.inp", "*NODE\n1,0,0,0\n*ELEMENT, TYPE=S3\n1, 1, 1,\n",
                    {"the file is truncated"});
  expect_unreadable("a.inp", "*NODE\n1,0,0,0\n*ELEMENT, TYPE=S3\n1, 1, 1,\n*STEP\n",
                    {"line 5", "not complete"});
  expect_unreadable("a.inp", "*INCLUDE, INPUT=mesh.inp\n", {"line 1", "included"});
  expect_unreadable("a.inp", "*NODE, INPUT=nodes.txt\n", {"line 1", "other files"});
}

TEST_F(Readers, RefuseWhatIsNoMesh) {
  expect_unreadable("a.vtu",
                    vtu(array("connectivity", "0 1 2 12") + array("offsets", "1 2 3 4") +
                        array("types", "10 10 10 10")),
                    {"cell 0, a tetrahedron, has only 1 corner"});
  expect_unreadable("a.vtu",
                    vtu(array("connectivity", "0 1 2 12 0 1 2 3 0 1 2 3 0 1 2 3") +
                        array("offsets", "4 8 12 16") + array("types", "10 10 10 10")),
                    {"cell 0 refers to a point that is not in the file, which has 12 points"});
  expect_unreadable("a.vtu",
                    vtu(array("connectivity", "0 1 2 3") + array("offsets", "1 2 3 4") +
                        array("types", "42 1 1 1") + array("faces", "9 3 0 1 2") +
                        array("faceoffsets", "5 -1 -1 -1")),
                    {"the faces of cell 0, a polyhedron, are damaged"});
  expect_unreadable("a.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n", {"not finite"});
  expect_unreadable("a.xyz", "1\n", {"the extension '.xyz' is unknown", ".msh", "folders"});
  expect_error(ExitCode::read, {"none.vtu", "does not exist"},
               [&] { read_mesh(folder_ / "none.vtu"); });
}

// Gmsh writes one mesh in several formats.
TEST_F(Readers, AgreeOnWhatGmshWrites) {
  const std::string geometry =
      file("box.geo",
           "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 2, 3};\nMesh.MeshSizeMax = 0.8;\n");
  std::vector<Figures> figures;
  for (const auto& [format, extension] :
       {std::pair{"msh41", "41.msh"}, {"msh22", "22.msh"}, {"inp", "inp"}, {"vtk", "vtk"}}) {
    const std::string output = (folder_ / (std::string("box.") + extension)).string();
    const ChildResult gmsh = run_child(
        {"gmsh", geometry, "-3", "-nt", "1", "-format", format, "-save_all", "-o", output});
    if (gmsh.exit_code != 0) GTEST_SKIP() << "gmsh is not installed";
    const MeshQuality q = mesh_quality(read_mesh(output));
    const Distribution& volume = metric(q, "volume");
    EXPECT_NEAR(volume.mean * static_cast<double>(volume.count), 6.0, 1e-9) << format;
    EXPECT_GT(volume.min, 0.0) << format;
    figures.push_back(figures_of(q));
  }
  for (const Figures& other : figures) {
    ASSERT_EQ(other.size(), figures[0].size());
    for (std::size_t i = 0; i < other.size(); ++i) {
      EXPECT_EQ(other[i].first, figures[0][i].first);
      EXPECT_NEAR(other[i].second, figures[0][i].second, 1e-6) << other[i].first;
    }
  }
}

}  // namespace
}  // namespace hexwall::test
