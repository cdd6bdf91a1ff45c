#include "exporters/vtk_files.h"

#include <bit>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <random>
#include <set>
#include <string>
#include <sys/resource.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "core/errors.h"
#include "exporters/zlib_compressor.h"
#include "support/block_mesh.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace hexwall {
namespace {

std::vector<unsigned char> compressed(const std::vector<unsigned char>& block) {
  vtkNew<ZlibCompressor> compressor;
  compressor->SetCompressionLevel(1);
  std::vector<unsigned char> result(compressor->GetMaximumCompressionSpace(block.size()));
  result.resize(compressor->Compress(block.data(), block.size(), result.data(), result.size()));
  return result;
}

std::vector<unsigned char> uncompressed(const std::vector<unsigned char>& bytes, std::size_t size) {
  vtkNew<vtkZLibDataCompressor> zlib;
  std::vector<unsigned char> result(size);
  result.resize(zlib->Uncompress(bytes.data(), bytes.size(), result.data(), size));
  return result;
}

TEST(ZlibCompressor, ShrinksWhatShrinksAndStoresTheRest) {
  std::vector<unsigned char> noise(100000);
  std::mt19937 random(1);
  for (unsigned char& byte : noise) byte = static_cast<unsigned char>(random());
  std::vector<unsigned char> regular(noise.size());
  for (std::size_t i = 0; i < regular.size(); ++i) {
    regular[i] = static_cast<unsigned char>(i % 100);
  }
  const std::size_t of_format = 100;  // headers of blocks, check sum
  EXPECT_LE(compressed(noise).size(), noise.size() + of_format);
  EXPECT_LT(compressed(regular).size(), regular.size() / 20);
  EXPECT_EQ(uncompressed(compressed(noise), noise.size()), noise);
  EXPECT_EQ(uncompressed(compressed(regular), regular.size()), regular);
}

// One byte of eight is the same always, as in doubles of one size: that saves less than it takes.
TEST(ZlibCompressor, StoresWhatShrinksALittle) {
  std::vector<unsigned char> block(100000);
  std::mt19937 random(2);
  for (std::size_t i = 0; i < block.size(); ++i) {
    block[i] = i % 8 == 7 ? 63 : static_cast<unsigned char>(random());
  }
  EXPECT_GE(compressed(block).size(), block.size());
  EXPECT_EQ(uncompressed(compressed(block), block.size()), block);
}

using testing::ElementsAre;
using testing::HasSubstr;

template <typename Reader>
vtkSmartPointer<vtkPointSet> read(const std::filesystem::path& path) {
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return vtkPointSet::SafeDownCast(reader->GetOutputAsDataSet());
}

auto read_vtu(const std::filesystem::path& path) {
  return read<vtkXMLUnstructuredGridReader>(path);
}
auto read_vtp(const std::filesystem::path& path) {
  return read<vtkXMLPolyDataReader>(path);
}

std::vector<double> values_of(vtkDataArray* array) {
  std::vector<double> values;
  if (array == nullptr) return values;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
      values.push_back(array->GetComponent(i, c));
  return values;
}

std::vector<double> as_doubles(const std::vector<int>& values) {
  return {values.begin(), values.end()};
}

std::vector<std::string> strings_of(vtkDataSet* data, const char* name) {
  std::vector<std::string> values;
  auto* array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
  if (array == nullptr) return values;
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i) values.push_back(array->GetValue(i));
  return values;
}

std::vector<int> points_of_cell(vtkDataSet* data, vtkIdType cell) {
  vtkNew<vtkIdList> ids;
  data->GetCellPoints(cell, ids);
  return {ids->begin(), ids->end()};
}

void expect_same_points(vtkPointSet* data, const std::vector<Vec3>& points) {
  ASSERT_EQ(data->GetNumberOfPoints(), static_cast<vtkIdType>(points.size()));
  EXPECT_EQ(data->GetPoints()->GetDataType(), VTK_DOUBLE);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int d = 0; d < 3; ++d)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(data->GetPoint(static_cast<vtkIdType>(i))[d]),
                std::bit_cast<std::uint64_t>(points[i][d]));
}

/// Two triangles, a polyline, a point; all kinds of arrays.
PolyData small_poly_data() {
  PolyData data;
  data.points = {{0.1, 0, 0}, {1.0 / 3, 0, 0}, {1, 1, 0}, {0, 1, 1e-300}};
  data.vertices.add(std::array{3});
  data.lines.add(std::vector{0, 1, 2, 3});
  data.polygons.add(std::array{0, 1, 2});
  data.polygons.add(std::array{0, 1, 2, 3});
  data.point_arrays.push_back({"uv", 2, std::vector<double>{0, 0, 1, 0, 1, 1, 0, 1.5}});
  data.point_arrays.push_back({"float", 1, std::vector<float>{0.5F, 1, 2, 3}});
  data.cell_arrays.push_back({"kind", 1, std::vector{7, 8, 9, 10}});
  data.texture_coordinates = "uv";
  data.strings.push_back({"names", {"a", "two words", "", "ünïcode"}});
  return data;
}

TEST(Vtp, ReadsBackAsWritten) {
  const TemporaryFolder folder;
  const PolyData written = small_poly_data();
  write_vtp(folder / "a.vtp", written);
  const auto data = read_vtp(folder / "a.vtp");
  expect_same_points(data, written.points);
  ASSERT_EQ(data->GetNumberOfCells(), 4);
  EXPECT_THAT(points_of_cell(data, 0), ElementsAre(3));
  EXPECT_THAT(points_of_cell(data, 1), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(points_of_cell(data, 2), ElementsAre(0, 1, 2));
  EXPECT_THAT(points_of_cell(data, 3), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(values_of(data->GetPointData()->GetArray("float")), ElementsAre(0.5, 1, 2, 3));
  EXPECT_THAT(values_of(data->GetCellData()->GetArray("kind")), ElementsAre(7, 8, 9, 10));
  EXPECT_EQ(data->GetPointData()->GetArray("float")->GetDataType(), VTK_FLOAT);
  EXPECT_EQ(data->GetCellData()->GetArray("kind")->GetDataType(), VTK_INT);
  EXPECT_THAT(strings_of(data, "names"), ElementsAre("a", "two words", "", "ünïcode"));
}

TEST(Vtp, TextureCoordinatesAreActive) {
  const TemporaryFolder folder;
  write_vtp(folder / "a.vtp", small_poly_data());
  const auto data = read_vtp(folder / "a.vtp");
  ASSERT_NE(data->GetPointData()->GetTCoords(), nullptr);
  EXPECT_THAT(values_of(data->GetPointData()->GetTCoords()), ElementsAre(0, 0, 1, 0, 1, 1, 0, 1.5));
}

TEST(Vtp, EmptyDataIsWritten) {
  const TemporaryFolder folder;
  write_vtp(folder / "a.vtp", {});
  EXPECT_EQ(read_vtp(folder / "a.vtp")->GetNumberOfPoints(), 0);
}

TEST(Vtp, AnArrayOfTheWrongLengthIsAnInternalError) {
  const TemporaryFolder folder;
  PolyData data = small_poly_data();
  data.cell_arrays.push_back({"short", 1, std::vector{1, 2}});
  EXPECT_THROW(write_vtp(folder / "a.vtp", data), Error);
  data.cell_arrays.back() = {"no components", 0, std::vector<int>{}};
  EXPECT_THROW(write_vtp(folder / "a.vtp", data), Error);
}

TEST(Vtp, MissingTextureCoordinatesAreAnInternalError) {
  const TemporaryFolder folder;
  PolyData data = small_poly_data();
  data.texture_coordinates = "st";
  EXPECT_THROW(write_vtp(folder / "a.vtp", data), Error);
}

TEST(Vtu, ReadsBackAsWritten) {
  const TemporaryFolder folder;
  const HexMesh mesh = block_mesh({});
  std::vector<double> quality(mesh.shape.size());
  for (std::size_t i = 0; i < quality.size(); ++i) quality[i] = 1.0 / static_cast<double>(i + 1);
  std::vector<double> vectors(3 * mesh.points.size(), 0.1);
  write_vtu(folder / "a.vtu", mesh, {{"quality", 1, quality}}, {{"vectors", 3, vectors}});
  const auto data = read_vtu(folder / "a.vtu");
  expect_same_points(data, mesh.points);
  ASSERT_EQ(data->GetNumberOfCells(), static_cast<vtkIdType>(mesh.shape.size()));
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) {
    EXPECT_EQ(data->GetCellType(i), VTK_HEXAHEDRON);
    EXPECT_THAT(points_of_cell(data, i),
                testing::ElementsAreArray(mesh.corners(static_cast<int>(i))));
  }
  EXPECT_EQ(values_of(data->GetCellData()->GetArray("quality")), quality);
  EXPECT_EQ(values_of(data->GetPointData()->GetArray("vectors")), vectors);
}

TEST(Vtu, ZonesAreNamed) {
  const TemporaryFolder folder;
  const HexMesh mesh = block_mesh({});
  write_vtu(folder / "a.vtu", mesh);
  const auto data = read_vtu(folder / "a.vtu");
  EXPECT_THAT(strings_of(data, "zone_names"), ElementsAre("layer_0", "layer_1"));
  EXPECT_EQ(values_of(data->GetCellData()->GetArray("zone")), as_doubles(mesh.layer));
}

TEST(Vtu, BoundaryFacesAreFoundByPatchName) {
  const TemporaryFolder folder;
  const HexMesh mesh = block_mesh({});
  write_vtu(folder / "a.vtu", mesh);
  const auto data = read_vtu(folder / "a.vtu");
  const auto names = strings_of(data, "patch_names");
  std::vector<std::set<std::set<vtkIdType>>> found(names.size());
  vtkDataArray* patch_of_face = data->GetCellData()->GetArray("patch_of_face");
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
    for (int f = 0; f < 6; ++f) {
      vtkIdList* face = data->GetCell(i)->GetFace(f)->GetPointIds();
      const int patch = static_cast<int>(patch_of_face->GetComponent(i, f));
      if (patch >= 0) found[patch].insert({face->begin(), face->end()});
    }
  ASSERT_EQ(names.size(), mesh.patches.size());
  for (std::size_t p = 0; p < names.size(); ++p) {
    EXPECT_EQ(names[p], mesh.patches[p].name);
    std::set<std::set<vtkIdType>> expected;
    for (const auto& f : mesh.patches[p].faces)
      expected.insert({f.vertices.begin(), f.vertices.end()});
    EXPECT_EQ(found[p], expected) << names[p];
  }
}

TEST(Vtu, EqualRunsWriteEqualBytes) {
  const TemporaryFolder folder;
  write_vtu(folder / "a.vtu", block_mesh({}));
  write_vtu(folder / "b.vtu", block_mesh({}));
  EXPECT_FALSE(bytes_of(folder / "a.vtu").empty());
  EXPECT_EQ(bytes_of(folder / "a.vtu"), bytes_of(folder / "b.vtu"));
}

TEST(Vtu, AMissingFolderIsAWriteErrorWithPathAndReason) {
  const TemporaryFolder folder;
  try {
    write_vtu(folder / "none/a.vtu", block_mesh({}));
    FAIL() << "nothing was thrown";
  } catch (const WriteError& e) {
    EXPECT_EQ(e.code(), ExitCode::write);
    EXPECT_THAT(e.what(), HasSubstr((folder / "none/a.vtu").string()));
    EXPECT_THAT(e.what(), HasSubstr("No such file or directory"));
  }
}

TEST(Vtu, AFileInPlaceOfTheFolderIsAWriteError) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  EXPECT_THROW(write_vtu(folder / "file/a.vtu", block_mesh({})), WriteError);
}

TEST(Vtu, AFolderOfThatNameIsAWriteErrorAndNothingIsLeft) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "a.vtu/x");
  EXPECT_THROW(write_vtu(folder / "a.vtu", block_mesh({})), WriteError);
  const std::filesystem::directory_iterator left(folder.path());
  EXPECT_EQ(std::distance(begin(left), end(left)), 1);
}

/// Lets this process write files of at most `bytes`: to a writer the same as a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*handler_)(int);
  rlimit old_{};
};

// The limits are within the XML and within the data that follow it. VTK is not to talk about it.
TEST(Vtu, AFullDiskKeepsTheOlderFile) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.vtu") << "older";
  const std::string path = (folder / "a.vtu").string();
  testing::internal::CaptureStderr();
  for (const rlim_t bytes : {1000, 20000}) {
    const FileSizeLimit limit(bytes);
    test::expect_error(ExitCode::write, {path.c_str(), "File too large"}, [&] {
      write_vtu(path, block_mesh({36, 20, 4}));
    });
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(bytes_of(folder / "a.vtu"), "older");
  const std::filesystem::directory_iterator left(folder.path());
  EXPECT_EQ(std::distance(begin(left), end(left)), 1);
}

}  // namespace
}  // namespace hexwall
