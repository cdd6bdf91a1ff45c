#include "colours.h"

#include <algorithm>
#include <array>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkStringArray.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include "core/errors.h"

namespace hexwall {
namespace {

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

/// The texts that whole numbers of an array stand for; null if they are only numbers.
vtkStringArray* names_of(vtkDataSet* data, const std::string& array) {
  const std::string name = array + "_names";
  return vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name.c_str()));
}

vtkSmartPointer<vtkLookupTable> categories(int first, int last) {
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  const int n = last - first + 1;
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

Colours colours_for(vtkDataArray* array, const std::vector<double>& fixed, vtkStringArray* names) {
  if (!fixed.empty()) return {ramp(fixed[0], fixed[1]), false};
  const bool scalar = array->GetNumberOfComponents() == 1;
  std::array<double, 2> range{};
  array->GetRange(range.data(), scalar ? 0 : -1);
  constexpr double most_categories = 4096;
  if (!scalar || !is_integer(array) || range[1] - range[0] >= most_categories) {
    return {ramp(range[0], range[1]), false};
  }
  const auto first = static_cast<int>(range[0]);
  const auto last = static_cast<int>(range[1]);
  Colours colours{categories(first, last), true};
  if (names == nullptr || first < 0 || last >= names->GetNumberOfValues()) return colours;
  for (int i = first; i <= last; ++i) colours.names.push_back(names->GetValue(i));
  return colours;
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

std::size_t longest_line(const std::string& text) {
  std::size_t longest = 0;
  std::size_t length = 0;
  for (const char c : text) {
    length = c == '\n' ? 0 : length + 1;
    longest = std::max(longest, length);
  }
  return longest;
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
  // The bar is as wide as about 11 letters: longer lines get smaller ones.
  const double letters = std::max(11.0, static_cast<double>(longest_line(title)));
  bar->GetTitleTextProperty()->SetFontSize(static_cast<int>(11.0 * font_size / letters));
  bar->SetLabelFormat("%.3g");
  bar->SetVerticalTitleSeparation(12);
  if (colours.whole_numbers) {
    bar->SetLabelFormat("%.0f");
    bar->SetUseCustomLabels(true);
    bar->SetCustomLabels(whole_labels(colours.table));
  }
  return bar;
}

/// The names, each on its colour, from the top down.
void add_names(const Colours& colours, int font_size, vtkRenderer* renderer) {
  const std::size_t width = std::max_element(colours.names.begin(), colours.names.end(),
                                             [](const std::string& a, const std::string& b) {
                                               return a.size() < b.size();
                                             })
                                ->size();
  double height = 0.93;
  for (std::size_t i = 0; i < colours.names.size(); ++i) {
    vtkNew<vtkTextActor> text;
    std::string padded = " " + colours.names[i] + " ";
    padded.resize(width + 2, ' ');
    text->SetInput(padded.c_str());
    text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    text->GetPositionCoordinate()->SetValue(0.06, height);
    std::array<double, 4> colour{};
    colours.table->GetTableValue(static_cast<vtkIdType>(i), colour.data());
    vtkTextProperty* look = text->GetTextProperty();
    look->SetFontFamilyToCourier();  // all boxes are equally wide
    look->SetFontSize(font_size);
    look->SetColor(0, 0, 0);
    look->SetBackgroundColor(colour.data());
    look->SetBackgroundOpacity(1);
    renderer->AddActor2D(text);
    height -= 2.0 * font_size / renderer->GetRenderWindow()->GetSize()[1];
  }
}

}  // namespace

Colours colour_by(const PictureOptions& options, vtkPolyDataMapper* mapper) {
  const std::string& name = options.array;
  vtkPolyData* surface = mapper->GetInput();
  vtkDataArray* on_points = surface->GetPointData()->GetArray(name.c_str());
  vtkDataArray* on_cells = surface->GetCellData()->GetArray(name.c_str());
  vtkDataArray* array = on_cells != nullptr ? on_cells : on_points;
  if (array == nullptr) throw UsageError("the input has no array named " + name);
  if (on_cells != nullptr) mapper->SetScalarModeToUseCellFieldData();
  if (on_cells == nullptr) mapper->SetScalarModeToUsePointFieldData();
  Colours colours = colours_for(array, options.range, names_of(surface, name));
  if (array->GetNumberOfComponents() > 1) colours.table->SetVectorModeToMagnitude();
  mapper->SelectColorArray(name.c_str());
  mapper->SetLookupTable(colours.table);
  mapper->UseLookupTableScalarRangeOn();
  mapper->ScalarVisibilityOn();
  return colours;
}

void add_legend(const Colours& colours, const std::string& title, int font_size,
                vtkRenderer* renderer) {
  constexpr std::size_t most_names = 24;
  if (colours.names.empty() || colours.names.size() > most_names) {
    renderer->AddActor2D(scalar_bar(colours, title, font_size));
  } else {
    add_names(colours, font_size, renderer);
  }
}

}  // namespace hexwall
