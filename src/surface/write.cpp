#include "surface/write.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <fstream>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkSTLWriter.h>
#include <vtkXMLPolyDataWriter.h>

#include "core/errors.h"
#include "surface/vtk_messages.h"

namespace hexwall {
namespace {

namespace fs = std::filesystem;

vtkSmartPointer<vtkPolyData> poly_data_of(const TriangleSurface& surface) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : surface.points) points->InsertNextPoint(p.data());
  vtkNew<vtkCellArray> cells;
  for (const auto& t : surface.triangles) cells->InsertNextCell({t[0], t[1], t[2]});
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

template <typename Writer>
void write_with(Writer* writer, const fs::path& path, const TriangleSurface& surface) {
  const VtkMessages messages;
  writer->SetFileName(path.c_str());
  writer->SetInputData(poly_data_of(surface));
  const bool is_written = writer->Write() != 0;
  if (!messages.error().empty()) throw WriteError(messages.error());
  if (!is_written || writer->GetErrorCode() != 0) throw WriteError("VTK could not write the file");
}

void write_stl(const fs::path& path, const TriangleSurface& surface) {
  vtkNew<vtkSTLWriter> writer;
  writer->SetFileTypeToBinary();
  write_with(writer.Get(), path, surface);
}

void write_vtp(const fs::path& path, const TriangleSurface& surface) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  write_with(writer.Get(), path, surface);
}

void write_vtk(const fs::path& path, const TriangleSurface& surface) {
  vtkNew<vtkPolyDataWriter> writer;
  writer->SetFileTypeToBinary();
  write_with(writer.Get(), path, surface);
}

void write_bytes(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw WriteError("the file could not be written; is there space and permission?");
}

void write_obj(const fs::path& path, const TriangleSurface& surface) {
  std::string text;
  for (const Vec3& p : surface.points) text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
  for (const auto& t : surface.triangles) {
    text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  }
  write_bytes(path, text);
}

void write_off(const fs::path& path, const TriangleSurface& surface) {
  std::string text = fmt::format("OFF\n{} {} 0\n", surface.points.size(), surface.triangles.size());
  for (const Vec3& p : surface.points) text += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
  for (const auto& t : surface.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  write_bytes(path, text);
}

template <typename Value>
void append_bytes(std::string& text, const Value* values, std::size_t count) {
  static_assert(std::endian::native == std::endian::little);
  text.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
}

// VTK's writer does not notice a full disk.
void write_ply(const fs::path& path, const TriangleSurface& surface) {
  std::string text = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      surface.points.size(), surface.triangles.size());
  for (const Vec3& p : surface.points) append_bytes(text, p.data(), 3);
  for (const auto& t : surface.triangles) {
    text.push_back(3);
    append_bytes(text, t.data(), 3);
  }
  write_bytes(path, text);
}

struct Format {
  std::string_view extension;
  void (*write)(const fs::path&, const TriangleSurface&);
};

constexpr std::array<Format, 6> formats{{{".stl", write_stl},
                                         {".obj", write_obj},
                                         {".ply", write_ply},
                                         {".off", write_off},
                                         {".vtp", write_vtp},
                                         {".vtk", write_vtk}}};

const Format& format_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : formats) {
    if (format.extension == extension) return format;
  }
  std::string known;
  for (const Format& format : formats) known += fmt::format(" {}", format.extension);
  throw WriteError(fmt::format("the extension '{}' is unknown. Known are{}", extension, known));
}

void check_target(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw WriteError("a directory has this name");
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) {
    throw WriteError(fmt::format("the folder '{}' does not exist", folder.string()));
  }
}

/// A temporary file next to the target, removed unless it has got the target's name.
class PartialFile {
 public:
  explicit PartialFile(const fs::path& target) : target_(target), path_(target) {
    path_ += ".part";
  }
  ~PartialFile() {
    std::error_code error;
    if (!is_kept_) fs::remove(path_, error);
  }
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  const fs::path& path() const { return path_; }

  void keep() {
    std::error_code error;
    fs::rename(path_, target_, error);
    if (error) throw WriteError(error.message());
    is_kept_ = true;
  }

 private:
  fs::path target_, path_;
  bool is_kept_ = false;
};

}  // namespace

void write_surface(const fs::path& path, const TriangleSurface& surface) {
  try {
    const Format& format = format_of(path);
    check_target(path);
    PartialFile file(path);
    format.write(file.path(), surface);
    file.keep();
  } catch (const WriteError& error) {
    throw WriteError(fmt::format("cannot write '{}': {}", path.string(), error.what()));
  }
}

}  // namespace hexwall
