#include "scene.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <vtkActor.h>
#include <vtkBillboardTextActor3D.h>
#include <vtkCamera.h>
#include <vtkExtractEdges.h>
#include <vtkExtractGeometry.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkGeometryFilter.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTextProperty.h>
#include <vtkTexture.h>
#include <vtkTubeFilter.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "camera.h"
#include "colours.h"
#include "core/errors.h"

namespace hexwall {
namespace {

constexpr double kBarWidth = 0.14;  ///< part of the picture's width that the scalar bar takes

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

vtkStringArray* labels_of(vtkDataSet* lines) {
  return vtkStringArray::SafeDownCast(lines->GetFieldData()->GetAbstractArray("labels"));
}

/// The texts of the field `labels` at the vertex cells, in front of everything.
void add_labels(vtkPolyData* lines, int font_size, vtkRenderer* renderer) {
  vtkStringArray* labels = labels_of(lines);
  vtkCellArray* vertices = lines->GetVerts();
  const vtkIdType count = std::min(vertices->GetNumberOfCells(), labels->GetNumberOfValues());
  for (vtkIdType i = 0; i < count; ++i) {
    vtkNew<vtkIdList> ids;
    vertices->GetCellAtId(i, ids);
    vtkNew<vtkBillboardTextActor3D> text;
    text->SetInput(labels->GetValue(i).c_str());
    text->SetPosition(lines->GetPoint(ids->GetId(0)));
    vtkTextProperty* look = text->GetTextProperty();
    look->SetFontSize(font_size);
    look->SetColor(0.1, 0.1, 0.1);
    look->SetBackgroundColor(1, 1, 1);
    look->SetBackgroundOpacity(0.75);
    look->SetJustificationToCentered();
    look->SetVerticalJustificationToCentered();
    renderer->AddActor(text);
  }
}

/// Lines and labels, or points where there are no labels.
void add_lines(const PictureOptions& options, double radius, vtkRenderWindow* window,
               vtkRenderer* scene) {
  const auto lines = read_data(options.lines);
  scene->AddActor(lines_actor(options.lines, radius));
  if (labels_of(lines) == nullptr) {
    scene->AddActor(vertices_actor(options.lines));
    return;
  }
  vtkNew<vtkRenderer> front;
  front->SetViewport(scene->GetViewport());
  front->SetLayer(1);
  front->SetActiveCamera(scene->GetActiveCamera());
  window->SetNumberOfLayers(2);
  window->AddRenderer(front);
  add_labels(vtkPolyData::SafeDownCast(lines), window->GetSize()[0] / 60, front);
}

/// Those of the surface, and of labels.
Points points_to_see(const PictureOptions& options, vtkPolyData* surface) {
  Points points = points_of(surface);
  if (options.lines.empty()) return points;
  const auto lines = read_data(options.lines);
  if (labels_of(lines) == nullptr) return points;
  Points all(3, points.cols() + lines->GetNumberOfPoints());
  all << points, points_of(lines);
  return all;
}

vtkSmartPointer<vtkRenderer> new_renderer(double left, double right) {
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetViewport(left, 0, right, 1);
  renderer->SetBackground(1, 1, 1);
  return renderer;
}

}  // namespace

void build_scene(const PictureOptions& options, vtkRenderWindow* window) {
  vtkSmartPointer<vtkDataSet> data = read_data(options.input);
  if (!options.clip.empty()) data = clipped(data, options.clip);
  if (data->GetNumberOfPoints() == 0) throw UsageError("--clip leaves nothing to show");
  const auto surface = surface_of(data);
  surface->GetFieldData()->ShallowCopy(data->GetFieldData());
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
    const std::string& title = options.title.empty() ? options.array : options.title;
    window->AddRenderer(bar);
    add_legend(colour_by(options, mapper), title, font_size, bar);
  }
  if (!options.texture.empty()) apply_checkerboard(surface, actor);
  scene->AddActor(actor);
  if (options.edges) scene->AddActor(edges_actor(surface));
  const bool has_labels = !options.lines.empty() && labels_of(read_data(options.lines)) != nullptr;
  if (!options.lines.empty()) {
    add_lines(options, 0.0012 * data->GetLength(), window, scene);
  }
  const double aspect = width * window->GetSize()[0] / window->GetSize()[1];
  // Labels reach beyond their places.
  PictureOptions with_margin = options;
  if (has_labels) with_margin.zoom *= 0.93;
  aim_camera(scene->GetActiveCamera(), points_to_see(options, surface), with_margin, aspect);
  scene->ResetCameraClippingRange();
}

}  // namespace hexwall
