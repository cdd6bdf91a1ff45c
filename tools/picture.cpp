// Renders a VTP or VTU file to PNG, without a display of its own: run it under xvfb-run.
//
//   xvfb-run -a hexwall-picture wall.vtu -o wall.png --array layer --edges
//   xvfb-run -a hexwall-picture surface.vtp -o s.png --texture checkerboard --lines critical.vtp
//   xvfb-run -a hexwall-picture wall.vtu -o cut.png --edges --clip 0,0,0,1,0,0 --view -1,0,0

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <Eigen/Dense>
#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkExtractEdges.h>
#include <vtkExtractGeometry.h>
#include <vtkFloatArray.h>
#include <vtkGeometryFilter.h>
#include <vtkImageData.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSmartPointer.h>
#include <vtkTextProperty.h>
#include <vtkTexture.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkWindowToImageFilter.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "core/errors.h"
#include "exporters/output_file.h"
#include "reference.h"
#include "report.h"

namespace hexwall {
namespace {

struct PictureOptions {
  std::string input;
  std::string output;
  std::string array;          ///< point or cell array that colours the surface; empty: none
  std::vector<double> range;  ///< values of the first and the last colour; empty: those of the data
  std::string texture;        ///< empty or "checkerboard"
  std::string lines;          ///< poly data file drawn on top as tubes; empty: none
  std::vector<double> view;   ///< direction from the data to the eye; empty: chosen from the data
  std::vector<double> clip;   ///< point and normal of a plane; cells on the normal's side stay
  double zoom = 1;
  std::string size = "1600x1200";
  bool edges = false;
  bool perspective = false;
};

constexpr double kBarWidth = 0.12;  ///< part of the picture's width that the scalar bar takes

/// Colours for numbers that are only names, such as patches: neighbours in the list differ well.
constexpr std::array<std::array<double, 3>, 12> kCategories{{{0.40, 0.65, 0.85},
                                                             {0.99, 0.75, 0.44},
                                                             {0.60, 0.82, 0.53},
                                                             {0.94, 0.52, 0.52},
                                                             {0.75, 0.66, 0.87},
                                                             {0.77, 0.62, 0.52},
                                                             {0.97, 0.71, 0.82},
                                                             {0.72, 0.72, 0.72},
                                                             {0.86, 0.86, 0.45},
                                                             {0.45, 0.82, 0.84},
                                                             {0.55, 0.55, 0.85},
                                                             {0.85, 0.88, 0.75}}};

/// Dark blue to yellow, evenly rising in lightness (samples of the viridis map).
constexpr std::array<std::array<double, 3>, 6> kRamp{{{0.267, 0.005, 0.329},
                                                      {0.254, 0.265, 0.530},
                                                      {0.164, 0.471, 0.558},
                                                      {0.135, 0.659, 0.518},
                                                      {0.478, 0.821, 0.318},
                                                      {0.993, 0.906, 0.144}}};

template <typename Reader>
vtkSmartPointer<vtkDataSet> read_with(const std::string& path) {
  vtkNew<Reader> reader;
  if (reader->CanReadFile(path.c_str()) == 0)
    throw ReadError(path + " is missing or not of the kind its name says");
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkSmartPointer<vtkDataSet> data = reader->GetOutputAsDataSet();
  if (data == nullptr || data->GetNumberOfPoints() == 0) throw ReadError(path + " has no points");
  return data;
}

vtkSmartPointer<vtkDataSet> read_data(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".vtp") return read_with<vtkXMLPolyDataReader>(path);
  if (extension == ".vtu") return read_with<vtkXMLUnstructuredGridReader>(path);
  throw ReadError(path + ": only .vtp and .vtu files can be rendered");
}

/// Whole cells on the side of the plane to which its normal points.
vtkSmartPointer<vtkDataSet> clipped(vtkDataSet* data, const std::vector<double>& plane) {
  vtkNew<vtkPlane> function;
  function->SetOrigin(plane[0], plane[1], plane[2]);
  function->SetNormal(plane[3], plane[4], plane[5]);
  vtkNew<vtkExtractGeometry> extract;
  extract->SetInputData(data);
  extract->SetImplicitFunction(function);
  extract->ExtractInsideOff();
  extract->ExtractBoundaryCellsOff();
  extract->Update();
  return extract->GetOutput();
}

/// The outer faces, with normals that are smooth except across sharp edges.
vtkSmartPointer<vtkPolyData> surface_of(vtkDataSet* data) {
  vtkNew<vtkGeometryFilter> geometry;
  geometry->SetInputData(data);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(geometry->GetOutputPort());
  normals->SetFeatureAngle(40);
  normals->ConsistencyOff();
  normals->Update();
  return normals->GetOutput();
}

vtkSmartPointer<vtkLookupTable> categories(double first, double last) {
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  const int n = static_cast<int>(last - first) + 1;
  table->SetNumberOfTableValues(n);
  for (int i = 0; i < n; ++i) {
    const auto& c = kCategories[static_cast<std::size_t>(i) % kCategories.size()];
    table->SetTableValue(i, c[0], c[1], c[2]);
  }
  table->SetTableRange(first - 0.5, last + 0.5);
  return table;
}

vtkSmartPointer<vtkLookupTable> ramp(double low, double high) {
  constexpr int n = 256;
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(n);
  for (int i = 0; i < n; ++i) {
    const double x = (kRamp.size() - 1) * static_cast<double>(i) / (n - 1);
    const std::size_t k = std::min(static_cast<std::size_t>(x), kRamp.size() - 2);
    const double t = x - static_cast<double>(k);
    std::array<double, 3> c{};
    for (int d = 0; d < 3; ++d) c[d] = (1 - t) * kRamp[k][d] + t * kRamp[k + 1][d];
    table->SetTableValue(i, c[0], c[1], c[2]);
  }
  table->SetTableRange(low, high > low ? high : low + 1);
  return table;
}

bool is_integer(vtkDataArray* array) {
  return array->GetDataType() != VTK_FLOAT && array->GetDataType() != VTK_DOUBLE;
}

/// The colours of an array's values; `whole_numbers`: one colour for each whole number.
struct Colours {
  vtkSmartPointer<vtkLookupTable> table;
  bool whole_numbers;
};

Colours colours_for(vtkDataArray* array, const std::vector<double>& fixed) {
  if (!fixed.empty()) return {ramp(fixed[0], fixed[1]), false};
  const bool scalar = array->GetNumberOfComponents() == 1;
  std::array<double, 2> range{};
  array->GetRange(range.data(), scalar ? 0 : -1);
  constexpr double most_categories = 4096;
  if (scalar && is_integer(array) && range[1] - range[0] < most_categories)
    return {categories(range[0], range[1]), true};
  return {ramp(range[0], range[1]), false};
}

/// Colours the mapper's surface by the array of the options and returns the colours.
Colours colour_by(const PictureOptions& options, vtkPolyDataMapper* mapper) {
  const std::string& name = options.array;
  vtkPolyData* surface = mapper->GetInput();
  vtkDataArray* on_points = surface->GetPointData()->GetArray(name.c_str());
  vtkDataArray* on_cells = surface->GetCellData()->GetArray(name.c_str());
  vtkDataArray* array = on_cells != nullptr ? on_cells : on_points;
  if (array == nullptr) throw UsageError("the input has no array named " + name);
  if (on_cells != nullptr) mapper->SetScalarModeToUseCellFieldData();
  if (on_cells == nullptr) mapper->SetScalarModeToUsePointFieldData();
  Colours colours = colours_for(array, options.range);
  if (array->GetNumberOfComponents() > 1) colours.table->SetVectorModeToMagnitude();
  mapper->SelectColorArray(name.c_str());
  mapper->SetLookupTable(colours.table);
  mapper->UseLookupTableScalarRangeOn();
  mapper->ScalarVisibilityOn();
  return colours;
}

/// Two by two tiles, large enough for smooth edges.
vtkSmartPointer<vtkImageData> checkerboard() {
  constexpr int n = 256;
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(n, n, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer());
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const bool dark = (i < n / 2) == (j < n / 2);
      const std::array<unsigned char, 3> colour = dark
                                                      ? std::array<unsigned char, 3>{60, 95, 150}
                                                      : std::array<unsigned char, 3>{245, 242, 232};
      pixel = std::copy(colour.begin(), colour.end(), pixel);
    }
  return image;
}

/// The image has two tiles each way, and one unit of the coordinates shall be one tile.
void halve_texture_coordinates(vtkPolyData* surface) {
  vtkDataArray* from = surface->GetPointData()->GetTCoords();
  if (from == nullptr) throw UsageError("the input has no texture coordinates");
  vtkNew<vtkFloatArray> to;
  to->SetName("tile");
  to->SetNumberOfComponents(2);
  to->SetNumberOfTuples(from->GetNumberOfTuples());
  for (vtkIdType i = 0; i < from->GetNumberOfTuples(); ++i)
    for (int c = 0; c < 2; ++c) to->SetComponent(i, c, from->GetComponent(i, c) / 2);
  surface->GetPointData()->SetTCoords(to);
}

void apply_checkerboard(vtkPolyData* surface, vtkActor* actor) {
  halve_texture_coordinates(surface);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(checkerboard());
  texture->RepeatOn();
  texture->InterpolateOn();
  texture->MipmapOn();
  actor->SetTexture(texture);
}

/// Labels at whole numbers, for a table with a colour for each.
vtkSmartPointer<vtkDoubleArray> whole_labels(vtkLookupTable* table) {
  constexpr int most_labels = 16;
  const int n = static_cast<int>(table->GetNumberOfTableValues());
  auto labels = vtkSmartPointer<vtkDoubleArray>::New();
  for (int i = 0; i < n; i += (n + most_labels - 1) / most_labels)
    labels->InsertNextValue(table->GetTableRange()[0] + 0.5 + i);
  return labels;
}

vtkSmartPointer<vtkScalarBarActor> scalar_bar(const Colours& colours, const std::string& title,
                                              int font_size) {
  auto bar = vtkSmartPointer<vtkScalarBarActor>::New();
  bar->SetLookupTable(colours.table);
  bar->SetTitle(title.c_str());
  bar->SetUnconstrainedFontSize(true);
  bar->SetMaximumWidthInPixels(100);
  bar->SetPosition(0.05, 0.1);
  bar->SetWidth(0.8);
  bar->SetHeight(0.8);
  for (vtkTextProperty* text : {bar->GetTitleTextProperty(), bar->GetLabelTextProperty()}) {
    text->SetColor(0, 0, 0);
    text->SetFontSize(font_size);
    text->ItalicOff();
    text->ShadowOff();
    text->BoldOff();
  }
  // The bar is as wide as about 9 letters: longer names get smaller ones.
  const double letters = std::max(9.0, static_cast<double>(title.size()));
  bar->GetTitleTextProperty()->SetFontSize(static_cast<int>(9.0 * font_size / letters));
  bar->SetLabelFormat("%.3g");
  bar->SetVerticalTitleSeparation(12);
  if (colours.whole_numbers) {
    bar->SetLabelFormat("%.0f");
    bar->SetUseCustomLabels(true);
    bar->SetCustomLabels(whole_labels(colours.table));
  }
  return bar;
}

vtkSmartPointer<vtkActor> surface_actor(const PictureOptions& options, vtkPolyDataMapper* mapper) {
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty* look = actor->GetProperty();
  if (options.texture.empty()) look->SetColor(0.87, 0.80, 0.76);
  look->SetAmbient(0.25);
  look->SetDiffuse(0.8);
  look->SetLineWidth(2);
  return actor;
}

/// The edges of the cells. VTK's own edge drawing leaves traces of the quads' diagonals.
vtkSmartPointer<vtkActor> edges_actor(vtkPolyData* surface) {
  vtkNew<vtkExtractEdges> edges;
  edges->SetInputData(surface);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(edges->GetOutputPort());
  mapper->ScalarVisibilityOff();
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(-2, -40);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.15, 0.15, 0.2);
  actor->GetProperty()->LightingOff();
  return actor;
}

/// Tubes around the polylines of a file, and balls at its vertex cells.
vtkSmartPointer<vtkActor> lines_actor(const std::string& path, double radius) {
  vtkNew<vtkTubeFilter> tubes;
  tubes->SetInputData(vtkPolyData::SafeDownCast(read_data(path)));
  tubes->SetRadius(radius);
  tubes->SetNumberOfSides(12);
  tubes->CappingOn();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(tubes->GetOutputPort());
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.80, 0.10, 0.12);
  actor->GetProperty()->SetAmbient(0.3);
  return actor;
}

vtkSmartPointer<vtkActor> vertices_actor(const std::string& path) {
  const auto data = read_data(path);
  vtkNew<vtkPolyData> vertices;
  vertices->SetPoints(vtkPolyData::SafeDownCast(data)->GetPoints());
  vertices->SetVerts(vtkPolyData::SafeDownCast(data)->GetVerts());
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(vertices);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.1, 0.1, 0.1);
  actor->GetProperty()->SetPointSize(12);
  actor->GetProperty()->RenderPointsAsSpheresOn();
  return actor;
}

using Points = Eigen::Matrix3Xd;

Points points_of(vtkDataSet* data) {
  Points points(3, data->GetNumberOfPoints());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) data->GetPoint(i, points.col(i).data());
  return points;
}

/// Columns: right, up, towards the eye.
Eigen::Matrix3d frame_looking_from(Eigen::Vector3d eye) {
  eye.normalize();
  const Eigen::Vector3d up =
      std::abs(eye.z()) > 0.99 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d frame;
  frame.col(2) = eye;
  frame.col(0) = up.cross(eye).normalized();
  frame.col(1) = eye.cross(frame.col(0));
  return frame;
}

/// The longest extent of the data to the right, the shortest towards the eye, slightly turned so
/// that depth can be seen.
Eigen::Matrix3d frame_of_data(const Points& points) {
  const Points centred = points.colwise() - points.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(centred * centred.transpose());
  Eigen::Matrix3d frame = axes.eigenvectors().rowwise().reverse();
  for (int c = 0; c < 2; ++c) {
    Eigen::Index largest = 0;
    frame.col(c).cwiseAbs().maxCoeff(&largest);
    if (frame(largest, c) < 0) frame.col(c) *= -1;
  }
  frame.col(2) = frame.col(0).cross(frame.col(1));
  const Eigen::AngleAxisd sideways(0.35, Eigen::Vector3d::UnitY());
  const Eigen::AngleAxisd down(-0.25, Eigen::Vector3d::UnitX());
  return frame * (sideways * down).toRotationMatrix();
}

/// Aims the camera so that the points fill the viewport of aspect ratio width : height.
void aim_camera(vtkCamera* camera, const Points& points, const PictureOptions& options,
                double aspect) {
  const Eigen::Matrix3d frame = options.view.empty()
                                    ? frame_of_data(points)
                                    : frame_looking_from(Eigen::Vector3d::Map(options.view.data()));
  const Points seen = frame.transpose() * points;
  const Eigen::Vector3d low = seen.rowwise().minCoeff();
  const Eigen::Vector3d high = seen.rowwise().maxCoeff();
  const Eigen::Vector3d size = high - low;
  const double half_height = 0.53 * std::max(size.y(), size.x() / aspect) / options.zoom;
  const Eigen::Vector3d target = frame * (low + high) / 2;
  const double half_angle = camera->GetViewAngle() * EIGEN_PI / 360;
  const double distance = half_height / std::tan(half_angle) + size.z() / 2;
  const Eigen::Vector3d eye = target + distance * frame.col(2);
  camera->SetFocalPoint(target.data());
  camera->SetPosition(eye.data());
  camera->SetViewUp(frame(0, 1), frame(1, 1), frame(2, 1));
  camera->SetParallelScale(half_height);
  camera->SetParallelProjection(!options.perspective);
}

std::array<int, 2> picture_size(const std::string& text) {
  std::array<int, 2> size{};
  char separator = 0;
  std::istringstream in(text);
  in >> size[0] >> separator >> size[1];
  constexpr int most_pixels = 16384;
  const bool fits =
      std::all_of(size.begin(), size.end(), [](int n) { return n > 0 && n <= most_pixels; });
  if (!in || separator != 'x' || !fits) throw UsageError("--size must be WIDTHxHEIGHT in pixels");
  return size;
}

vtkSmartPointer<vtkRenderer> new_renderer(double left, double right) {
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetViewport(left, 0, right, 1);
  renderer->SetBackground(1, 1, 1);
  return renderer;
}

/// Fills the window from the file: the surface, the lines over it, and a bar with the colours.
void build_scene(const PictureOptions& options, vtkRenderWindow* window) {
  vtkSmartPointer<vtkDataSet> data = read_data(options.input);
  if (!options.clip.empty()) data = clipped(data, options.clip);
  if (data->GetNumberOfPoints() == 0) throw UsageError("--clip leaves nothing to show");
  const auto surface = surface_of(data);
  const double width = options.array.empty() ? 1 : 1 - kBarWidth;
  const auto scene = new_renderer(0, width);
  window->AddRenderer(scene);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  mapper->ScalarVisibilityOff();
  const auto actor = surface_actor(options, mapper);
  if (!options.array.empty()) {
    const auto bar = new_renderer(width, 1);
    const int font_size = std::max(10, window->GetSize()[0] / 70);
    bar->AddActor2D(scalar_bar(colour_by(options, mapper), options.array, font_size));
    window->AddRenderer(bar);
  }
  if (!options.texture.empty()) apply_checkerboard(surface, actor);
  scene->AddActor(actor);
  if (options.edges) scene->AddActor(edges_actor(surface));
  if (!options.lines.empty()) {
    scene->AddActor(lines_actor(options.lines, 0.0012 * data->GetLength()));
    scene->AddActor(vertices_actor(options.lines));
  }
  const double aspect = width * window->GetSize()[0] / window->GetSize()[1];
  aim_camera(scene->GetActiveCamera(), points_of(surface), options, aspect);
  scene->ResetCameraClippingRange();
}

void write_png(const std::string& path, vtkRenderWindow* window) {
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(image->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  const std::string content(bytes->Begin(), bytes->End());
  write_output_file(path, content);
}

void render(const PictureOptions& options) {
  // VTK would abort without a word about what to do.
  if (std::getenv("DISPLAY") == nullptr)
    throw UsageError("no display: run hexwall-picture under xvfb-run -a");
  const auto size = picture_size(options.size);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(8);
  window->SetSize(size[0], size[1]);
  build_scene(options, window);
  window->Render();
  write_png(options.output, window);
}

void add_reference_flag(CLI::App& app, const std::string& flag,
                        const std::function<std::string(const CommandInfo&)>& page) {
  app.add_flag_callback(flag,
                        [&app, page] {
                          fmt::print("{}", page(command_info(app.get_name(), app)));
                          throw CLI::Success();
                        })
      ->group("");
}

void declare_options(CLI::App& app, PictureOptions& o) {
  app.add_option("INPUT", o.input, "VTP or VTU file")->required();
  app.add_option("-o,--output", o.output, "PNG file to write")->required();
  app.add_option("--array", o.array, "point or cell array that gives the colours");
  app.add_option("--range", o.range, "values LOW,HIGH of the first and the last colour")
      ->delimiter(',')
      ->expected(2);
  app.add_flag("--edges", o.edges, "draw the edges of the cells");
  app.add_option("--texture", o.texture, "tiles of one unit of the texture coordinates")
      ->check(CLI::IsMember({"checkerboard"}));
  app.add_option("--view", o.view, "direction x,y,z from the data to the eye")
      ->delimiter(',')
      ->expected(3);
  app.add_option("--clip", o.clip, "show only cells beyond x,y,z in the direction nx,ny,nz")
      ->delimiter(',')
      ->expected(6);
  app.add_option("--zoom", o.zoom, "magnification, 1: all is seen")->check(CLI::PositiveNumber);
  app.add_option("--size", o.size, "size in pixels")->capture_default_str();
  app.add_option("--lines", o.lines, "VTP file whose polylines are drawn on top");
  app.add_flag("--perspective", o.perspective, "perspective instead of parallel projection");
  app.set_version_flag("--version", "hexwall-picture " + version());
  // For what is made from the program itself, as `hexwall reference` is.
  add_reference_flag(app, "--reference-man",
                     [](const CommandInfo& command) { return man_page(command, {"hexwall"}); });
  add_reference_flag(app, "--reference-bash",
                     [](const CommandInfo& command) { return bash_completion(command, {}); });
}

}  // namespace
}  // namespace hexwall

int main(int argc, char** argv) {
  hexwall::PictureOptions options;
  CLI::App app("Renders a VTP or VTU file to PNG; run it under xvfb-run -a", "hexwall-picture");
  hexwall::declare_options(app, options);
  try {
    app.parse(argc, argv);
    hexwall::render(options);
    return 0;
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : static_cast<int>(hexwall::ExitCode::usage);
  } catch (const hexwall::Error& e) {
    fmt::print(stderr, "hexwall-picture: {}\n", e.what());
    return static_cast<int>(e.code());
  } catch (const std::exception& e) {
    fmt::print(stderr, "hexwall-picture: internal error: {}\n", e.what());
    return static_cast<int>(hexwall::ExitCode::internal);
  }
}
