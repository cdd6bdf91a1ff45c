// VTK's formats in all the ways in which VTK itself writes them, and files that are damaged.

#include <fstream>
#include <ostream>

#include <gtest/gtest.h>
#include <vtkBitArray.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include "support/expect_error.h"
#include "support/temporary_folder.h"
#include "surface/read.h"

namespace hexwall {
namespace {

using test::expect_error;

template <typename Array>
void add_array(vtkFieldData* data, const char* name, int tuples) {
  vtkNew<Array> array;
  array->SetName(name);
  for (int i = 0; i < tuples; ++i) array->InsertNextValue(i % 2);
  data->AddArray(array);
}

/// A vertex, a line, a triangle, a quad and a strip of two triangles, with their numbers.
void fill(vtkPolyData* data) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = 0; i < 10; ++i) points->InsertNextPoint(0.5 * (i - i % 2) + 1.0 / 3.0, i % 2, 0.0);
  data->SetPoints(points);
  vtkNew<vtkCellArray> verts, lines, polys, strips;
  verts->InsertNextCell({0});
  lines->InsertNextCell({0, 1});
  polys->InsertNextCell({0, 2, 1});
  polys->InsertNextCell({2, 4, 5, 3});
  strips->InsertNextCell({4, 6, 5, 7});
  data->SetVerts(verts);
  data->SetLines(lines);
  data->SetPolys(polys);
  data->SetStrips(strips);
  vtkNew<vtkDoubleArray> numbers;
  numbers->SetName("number of cell");
  for (int i = 0; i < 5; ++i) numbers->InsertNextValue(i);
  data->GetCellData()->AddArray(numbers);
  vtkNew<vtkDoubleArray> places;
  places->SetName("place");
  places->SetNumberOfComponents(3);
  for (int i = 0; i < 10; ++i) places->InsertNextTuple(points->GetPoint(i));
  data->GetPointData()->AddArray(places);
  vtkNew<vtkStringArray> words;
  words->SetName("words");
  for (int i = 0; i < 5; ++i) words->InsertNextValue(std::string(30 * i * i, 'w'));
  data->GetCellData()->AddArray(words);
  add_array<vtkUnsignedCharArray>(data->GetCellData(), "bytes", 5);
  add_array<vtkIdTypeArray>(data->GetPointData(), "ids", 10);
  add_array<vtkDoubleArray>(data->GetFieldData(), "time", 1);
}

void expect_filled(const ReadResult& read) {
  ASSERT_EQ(read.surface.triangles.size(), 5U);
  ASSERT_EQ(read.surface.points.size(), 8U);
  ASSERT_EQ(read.cell_arrays.size(), 2U);
  EXPECT_EQ(read.cell_arrays[0].name, "number of cell");
  EXPECT_EQ(read.cell_arrays[0].values, (std::vector<double>{2, 3, 3, 4, 4}));
  EXPECT_EQ(read.cell_arrays[1].values, (std::vector<double>{0, 1, 1, 0, 0}));
  ASSERT_EQ(read.point_arrays.size(), 2U);
  EXPECT_EQ(read.point_arrays[0].components, 3);
  for (std::size_t v = 0; v < read.surface.points.size(); ++v) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(read.point_arrays[0].values[3 * v + k], read.surface.points[v][k]);
    }
    EXPECT_EQ(read.point_arrays[1].values[v], static_cast<double>(v % 2));
    EXPECT_GE(read.surface.points[v].x(), 0.3);
  }
  for (const auto& t : read.surface.triangles) {
    for (const int v : t) EXPECT_LT(v, 8);
  }
}

// --- what VTK writes ----------------------------------------------------------------------------

struct XmlStyle {
  int mode;
  bool is_base64;
  int compressor;
  int byte_order;
  int header;
};

void PrintTo(const XmlStyle& style, std::ostream* out) {
  *out << style.mode << style.is_base64 << style.compressor << style.byte_order << style.header;
}

class XmlStyles : public testing::TestWithParam<XmlStyle> {};

TEST_P(XmlStyles, AreRead) {
  const TemporaryFolder folder;
  vtkNew<vtkPolyData> data;
  fill(data);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetFileName((folder / "a.vtp").c_str());
  writer->SetDataMode(GetParam().mode);
  writer->SetEncodeAppendedData(GetParam().is_base64);
  writer->SetCompressorType(GetParam().compressor);
  writer->SetByteOrder(GetParam().byte_order);
  writer->SetHeaderType(GetParam().header);
  writer->SetBlockSize(64);  // several blocks, the last one smaller
  ASSERT_EQ(writer->Write(), 1);
  expect_filled(read_surface(folder / "a.vtp"));
}

using Xml = vtkXMLWriter;
INSTANTIATE_TEST_SUITE_P(
    , XmlStyles,
    testing::Values(XmlStyle{Xml::Ascii, false, Xml::NONE, Xml::LittleEndian, Xml::UInt32},
                    XmlStyle{Xml::Binary, false, Xml::NONE, Xml::LittleEndian, Xml::UInt32},
                    XmlStyle{Xml::Binary, false, Xml::ZLIB, Xml::LittleEndian, Xml::UInt64},
                    XmlStyle{Xml::Binary, false, Xml::LZ4, Xml::BigEndian, Xml::UInt32},
                    XmlStyle{Xml::Appended, false, Xml::NONE, Xml::BigEndian, Xml::UInt64},
                    XmlStyle{Xml::Appended, false, Xml::LZMA, Xml::LittleEndian, Xml::UInt32},
                    XmlStyle{Xml::Appended, true, Xml::NONE, Xml::LittleEndian, Xml::UInt32},
                    XmlStyle{Xml::Appended, true, Xml::ZLIB, Xml::LittleEndian, Xml::UInt64}));

struct LegacyStyle {
  int type, version;
};

void PrintTo(const LegacyStyle& style, std::ostream* out) {
  *out << style.type << style.version;
}

class LegacyStyles : public testing::TestWithParam<LegacyStyle> {};

TEST_P(LegacyStyles, AreRead) {
  const TemporaryFolder folder;
  vtkNew<vtkPolyData> data;
  fill(data);
  vtkNew<vtkPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetFileName((folder / "a.vtk").c_str());
  writer->SetFileType(GetParam().type);
  writer->SetFileVersion(GetParam().version);
  ASSERT_EQ(writer->Write(), 1);
  expect_filled(read_surface(folder / "a.vtk"));
}

INSTANTIATE_TEST_SUITE_P(
    , LegacyStyles,
    testing::Values(LegacyStyle{VTK_ASCII, vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2},
                    LegacyStyle{VTK_ASCII, vtkDataWriter::VTK_LEGACY_READER_VERSION_5_1},
                    LegacyStyle{VTK_BINARY, vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2},
                    LegacyStyle{VTK_BINARY, vtkDataWriter::VTK_LEGACY_READER_VERSION_5_1}));

// --- what VTK reads -----------------------------------------------------------------------------

ReadResult read_text(const std::string& name, const std::string& content) {
  const TemporaryFolder folder;
  std::ofstream(folder / name, std::ios::binary) << content;
  return read_surface(folder / name);
}

const std::string legacy_triangle =
    "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"
    "POLYGONS 1 4\n3 0 1 2\n";

TEST(ReadLegacyVtk, TakesEveryKindOfArray) {
  const ReadResult read = read_text(
      "a.vtk", legacy_triangle +
                   "CELL_DATA 1\nCOLOR_SCALARS colour 2\n1 0.5\nTENSORS t float\n1 2 3\n4 5 6\n7 8 "
                   "9\nPOINT_DATA 3\nNORMALS n float\n0 0 1 0 0 1 0 0 1\n"
                   "TEXTURE_COORDINATES uv 2 double\n1 2 3 4 5 6\nSCALARS flag bit 1\n"
                   "LOOKUP_TABLE own\n1 0 1\nLOOKUP_TABLE own 2\n0 0 0 1 1 1 1 1\n"
                   "GLOBAL_IDS id vtkIdType\n7 8 9\n"
                   "METADATA\nINFORMATION 0\n\nFIELD data 1\na%20b 1 3 long\n1 2 3\n");
  ASSERT_EQ(read.cell_arrays.size(), 2U);
  EXPECT_EQ(read.cell_arrays[0].values, (std::vector<double>{255, 128}));
  EXPECT_EQ(read.cell_arrays[1].components, 9);
  ASSERT_EQ(read.point_arrays.size(), 5U);
  EXPECT_EQ(read.point_arrays[1].values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(read.point_arrays[2].values, (std::vector<double>{1, 0, 1}));
  EXPECT_EQ(read.point_arrays[3].values, (std::vector<double>{7, 8, 9}));
  EXPECT_EQ(read.point_arrays[4].name, "a b");
}

std::string vtp(const std::string& pieces) {
  return "<?xml version=\"1.0\"?><!-- a > b --><VTKFile type='PolyData'><PolyData>" + pieces +
         "</PolyData></VTKFile>";
}

std::string piece(const std::string& cells, const std::string& offsets = "3",
                  const std::string& array = "<DataArray type=\"Int8\" Name=\"a&amp;b\">") {
  return "<Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><Points><DataArray type=\"Float64\">"
         "0 0 0 1 0 0 0 1 0</DataArray></Points><Polys>"
         "<DataArray type=\"Int64\" Name=\"connectivity\">" +
         cells + "</DataArray><DataArray type=\"Int64\" Name=\"offsets\">" + offsets +
         "</DataArray></Polys><CellData>" + array + "5</DataArray></CellData></Piece>";
}

TEST(ReadVtp, JoinsPieces) {
  const ReadResult read = read_text("a.vtp", vtp(piece("0 1 2") + piece("2 1 0")));
  ASSERT_EQ(read.surface.triangles.size(), 2U);
  ASSERT_EQ(read.cell_arrays.size(), 1U);
  EXPECT_EQ(read.cell_arrays[0].name, "a&b");
  EXPECT_EQ(read.cell_arrays[0].values, (std::vector<double>{5, 5}));
}

TEST(ReadVtp, LeavesOutArraysThatNotAllPiecesHave) {
  const std::string other = piece("0 1 2", "3", "<DataArray type=\"Int8\" Name=\"c\">");
  const ReadResult read = read_text("a.vtp", vtp(piece("0 1 2") + other));
  EXPECT_TRUE(read.cell_arrays.empty());
  EXPECT_EQ(read.notes.size(), 3U);  // two arrays, and equal points
}

// --- errors -------------------------------------------------------------------------------------

struct Damage {
  const char *name, *what;
  std::string content;
};

void PrintTo(const Damage& damage, std::ostream* out) {
  *out << damage.what;
}

class DamagedFiles : public testing::TestWithParam<Damage> {};

TEST_P(DamagedFiles, AreRefused) {
  expect_error(ExitCode::read, {GetParam().name, GetParam().what},
               [] { read_text(GetParam().name, GetParam().content); });
}

std::string polydata(const std::string& rest) {
  return "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n"
         "0 0 0 1 0 0 0 1 0\n" +
         rest;
}

std::string grid(const std::string& rest) {
  return "# vtk DataFile Version 5.1\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 float\n"
         "0 0 0 1 0 0 0 1 0\n" +
         rest;
}

INSTANTIATE_TEST_SUITE_P(
    Legacy, DamagedFiles,
    testing::Values(
        Damage{"a.vtk", "unrecognized", "# vtk DataFile Version 3.0\nx\nHEX\n"},
        Damage{"a.vtk", "structured_points",
               "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\n"},
        Damage{"a.vtk", "truncated", "# vtk DataFile Version 3.0"},
        Damage{"a.vtk", "truncated", polydata("POLYGONS 1 99999999999\n3 0 1 2\n")},
        Damage{"a.vtk", "truncated", polydata("CELL_DATA 18446744073709551615\nVECTORS v float\n")},
        Damage{"a.vtk", "more corners", polydata("POLYGONS 2 4\n3 0 1 2\n")},
        Damage{"a.vtk", "more corners", polydata("POLYGONS 1 4\n-3 0 1 2\n")},
        Damage{"a.vtk", "out of range", polydata("POLYGONS 1 4\n3 0 1 4294967296\n")},
        Damage{"a.vtk", "'-1' is no count", polydata("POLYGONS -1 4\n3 0 1 2\n")},
        Damage{"a.vtk", "'nonsense'", polydata("NONSENSE")},
        Damage{"a.vtk", "'one' is not a number", polydata("POLYGONS 1 4\n3 0 one 2\n")},
        Damage{"a.vtk", "unknown type 'colour'", polydata("CELL_DATA 1\nVECTORS v colour\n1\n")},
        Damage{"a.vtk", "LOOKUP_TABLE", polydata("CELL_DATA 1\nSCALARS s int\n1\n")},
        Damage{"a.vtk", "5000 components",
               polydata("FIELD f 0\nCELL_DATA 0\nFIELD f 1\na 5000 0 int\n")},
        Damage{"a.vtk", "offsets", grid("CELLS 2 3\n0 3\n0 1 2\n")},
        Damage{"a.vtk", "more corners",
               grid("CELLS 2 3\nOFFSETS vtktypeint64\n0 9\nCONNECTIVITY vtktypeint64\n0 1 2\n")},
        Damage{"a.vtk", "1 cells, but 0 cell types",
               grid("CELLS 2 3\nOFFSETS vtktypeint64\n0 3\nCONNECTIVITY vtktypeint64\n0 1 2\n")},
        Damage{"a.vtk", "pixel of 3 corners",
               grid("CELLS 2 3\nOFFSETS vtktypeint64\n0 3\nCONNECTIVITY vtktypeint64\n0 1 2\n"
                    "CELL_TYPES 1\n8\n")}));

std::string nested(int depth) {
  std::string content;
  for (int i = 0; i < depth; ++i) content += "<a>";
  return content;
}

/// A piece whose connectivity is in base64.
std::string encoded(const std::string& attributes, const std::string& data) {
  std::string content = vtp(piece("0 1 2"));
  content.replace(content.find("type='PolyData'"), 0, attributes + " ");
  const std::string array = "Name=\"connectivity\">0 1 2";
  return content.replace(content.find(array), array.size(),
                         "Name=\"connectivity\" format=\"binary\">" + data);
}

INSTANTIATE_TEST_SUITE_P(
    Xml, DamagedFiles,
    testing::Values(
        Damage{"a.vtp", "within a tag", "<VTKFile type=\"a>"},
        Damage{"a.vtp", "do not match", "<VTKFile></PolyData>"},
        Damage{"a.vtp", "too deep", nested(1000)}, Damage{"a.vtp", "without a name", "< a>"},
        Damage{"a.vtp", "without a value", "<VTKFile type>"},
        Damage{"a.vtp", "without an end", "<a\"b c=\"d>"},
        Damage{"a.vtp", "PolyData", "<VTKFile><UnstructuredGrid/></VTKFile>"},
        Damage{"a.vtp", "no points", vtp("<Piece NumberOfPoints=\"3\"/>")},
        Damage{"a.vtp", "'Polys' is missing", vtp("<Piece NumberOfPolys=\"1\"/>")},
        Damage{"a.vtp", "'offsets' is missing", vtp("<Piece NumberOfPolys=\"1\"><Polys/></Piece>")},
        Damage{"a.vtp", "is 99999999999", vtp("<Piece NumberOfPoints=\"99999999999\"/>")},
        Damage{"a.vtp", "truncated", vtp(piece("0 1"))},
        Damage{"a.vtp", "does not end", vtp(piece("0 1 2", "-3"))},
        Damage{"a.vtp", "out of range", vtp(piece("0 1 3"))},
        Damage{"a.vtp", "0 components",
               vtp(piece("0 1 2", "3",
                         "<DataArray Name=\"a\" type=\"Int8\" NumberOfComponents=\"0\">"))},
        Damage{"a.vtp", "unknown type 'Int7'",
               vtp(piece("0 1 2", "3", "<DataArray Name=\"a\" type=\"Int7\">"))},
        Damage{"a.vtp", "truncated",
               vtp(piece("0 1 2", "3",
                         "<DataArray Name=\"a\" type=\"Int8\" format=\"appended\" offset=\"7\">"))},
        Damage{"a.vtp", "base64", encoded("", "GAAA!AA=")},
        Damage{"a.vtp", "truncated", encoded("", "GAAAAAA=")},
        Damage{"a.vtp", "truncated", encoded("", "AgAAAAA=")},
        Damage{"a.vtp", "'zip' is unknown", encoded("compressor='zip'", "GAAAAAA=")},
        // One block of 24 bytes, of which 3 are there; 1 block of 2^30 bytes; 1 block of 1 byte.
        Damage{"a.vtp", "compressed data",
               encoded("compressor='vtkZLibDataCompressor'", "AQAAABgAAAAAAAAAAwAAAA==AAAA")},
        Damage{"a.vtp", "too large",
               encoded("compressor='vtkZLibDataCompressor'", "AQAAAAAAAEAAAAAAAwAAAA==AAAA")},
        Damage{"a.vtp", "too large", encoded("header_type='UInt64'", "AAAAAAAAAP8=")},
        Damage{"a.vtp", "truncated",
               encoded("compressor='vtkZLibDataCompressor'", "AAAAABgAAAAAAAAA")}));

}  // namespace
}  // namespace hexwall
