#include "surface/read_legacy_vtk.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <vtkCellType.h>

#include "core/errors.h"
#include "surface/number_source.h"
#include "surface/vtk_cells.h"

namespace hexwall {
namespace {

constexpr std::size_t most_components = 1000;

using CornerLists = std::vector<std::vector<int>>;

/// Arrays of points or of cells, after the line that says how many of these there are.
struct Attributes {
  std::size_t count = 0;
  std::vector<SurfaceArray> arrays;
};

struct File {
  NumberSource source;
  Encoding encoding = Encoding::text;
  bool has_offsets = false;  ///< cells of version 5: where each begins, then all corners
  bool is_grid = false;
  std::vector<Vec3> points = {};
  std::array<CornerLists, 4> parts = {};  ///< of polygonal data, in the order of `part_words`
  CornerLists cells = {};                 ///< of a grid
  std::vector<int> types = {};            ///< of the cells of a grid
  Attributes point_data = {}, cell_data = {};
  Attributes* data = nullptr;  ///< where arrays go
};

// The cells' own order, whatever the order in the file.
constexpr std::array<std::string_view, 4> part_words{"vertices", "lines", "polygons",
                                                     "triangle_strips"};
constexpr std::array<int, 4> part_types{VTK_POLY_VERTEX, VTK_POLY_LINE, VTK_POLYGON,
                                        VTK_TRIANGLE_STRIP};

// --- words --------------------------------------------------------------------------------------

std::string lower_case(std::string_view word) {
  std::string lower(word);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

std::string next_word(File& file) {
  return lower_case(file.source.word());
}

std::size_t next_count(File& file) {
  return count_of(file.source.word());
}

// Blanks in names are written as %20, and so on.
std::string decoded(std::string_view name) {
  std::string result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    unsigned code = 0;
    const char* digits = name.data() + i + 1;
    if (name[i] == '%' && i + 2 < name.size() &&
        std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
      result += static_cast<char>(code);
      i += 2;
    } else {
      result += name[i];
    }
  }
  return result;
}

// --- numbers ------------------------------------------------------------------------------------

struct Type {
  std::string_view name;
  Scalar scalar;
};

// A vtkIdType is written as an int.
constexpr std::array<Type, 14> types{{{"char", Scalar::int8},
                                      {"signed_char", Scalar::int8},
                                      {"unsigned_char", Scalar::uint8},
                                      {"short", Scalar::int16},
                                      {"unsigned_short", Scalar::uint16},
                                      {"int", Scalar::int32},
                                      {"unsigned_int", Scalar::uint32},
                                      {"vtkidtype", Scalar::int32},
                                      {"long", Scalar::int64},
                                      {"unsigned_long", Scalar::uint64},
                                      {"vtktypeint64", Scalar::int64},
                                      {"vtktypeuint64", Scalar::uint64},
                                      {"float", Scalar::float32},
                                      {"double", Scalar::float64}}};

// After the last word of a line that numbers follow: in binary files they begin behind its end.
void begin_numbers(File& file) {
  if (file.encoding != Encoding::text) file.source.line();
}

std::vector<double> read_bits(File& file, std::size_t count) {
  std::vector<double> values;
  if (file.encoding == Encoding::text) {
    while (values.size() < count) values.push_back(file.source.number(Scalar::int8, file.encoding));
    return values;
  }
  for (const char byte : file.source.bytes(count / 8 + (count % 8 == 0 ? 0 : 1))) {
    for (int bit = 7; bit >= 0 && values.size() < count; --bit) {
      values.push_back((static_cast<unsigned char>(byte) >> bit) & 1U);
    }
  }
  return values;
}

std::vector<double> read_numbers(File& file, std::string_view type, std::size_t count) {
  begin_numbers(file);
  if (type == "bit") return read_bits(file, count);
  const auto* known =
      std::find_if(types.begin(), types.end(), [&](const Type& t) { return t.name == type; });
  if (known == types.end()) throw ReadError(fmt::format("numbers of the unknown type '{}'", type));
  std::vector<double> values;
  while (values.size() < count) {
    values.push_back(file.source.number(known->scalar, file.encoding));
  }
  return values;
}

std::size_t product(std::size_t a, std::size_t b) {
  if (a != 0 && b > std::numeric_limits<std::size_t>::max() / a) {
    throw ReadError("the file is truncated");
  }
  return a * b;
}

// --- geometry -----------------------------------------------------------------------------------

void read_points(File& file) {
  const std::size_t count = next_count(file);
  const std::string type = next_word(file);
  const std::vector<double> x = read_numbers(file, type, product(3, count));
  file.points.clear();
  for (std::size_t i = 0; i < x.size(); i += 3) file.points.emplace_back(x[i], x[i + 1], x[i + 2]);
}

std::vector<double> read_named(File& file, std::string_view name, std::size_t count) {
  if (next_word(file) != name) throw ReadError(fmt::format("the word {} is missing", name));
  return read_numbers(file, next_word(file), count);
}

/// Versions below 5: each cell is the number of its corners, then these.
CornerLists read_counted_cells(File& file, std::size_t count, std::size_t size) {
  const std::vector<double> numbers = read_numbers(file, "int", size);
  CornerLists cells;
  auto next = numbers.begin();
  for (std::size_t i = 0; i < count; ++i) {
    const auto left = static_cast<double>(numbers.end() - next);
    if (left < 1.0 || !(*next >= 0.0) || *next > left - 1.0) {
      throw ReadError(fmt::format("cell {} has more corners than there are", i));
    }
    std::vector<int>& cell = cells.emplace_back();
    for (int corners = index_of(*next++); corners > 0; --corners) cell.push_back(index_of(*next++));
  }
  return cells;
}

CornerLists read_offset_cells(File& file, std::size_t count, std::size_t size) {
  const std::vector<double> offsets = read_named(file, "offsets", count);
  const std::vector<double> corners = read_named(file, "connectivity", size);
  CornerLists cells;
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
    if (!(offsets[i] >= 0.0 && offsets[i] <= offsets[i + 1]) ||
        offsets[i + 1] > static_cast<double>(size)) {
      throw ReadError(fmt::format("cell {} has more corners than there are", i));
    }
    std::vector<int>& cell = cells.emplace_back();
    for (auto k = static_cast<std::size_t>(offsets[i]); static_cast<double>(k) < offsets[i + 1];
         ++k) {
      cell.push_back(index_of(corners[k]));
    }
  }
  return cells;
}

CornerLists read_cells(File& file) {
  const std::size_t count = next_count(file);
  const std::size_t size = next_count(file);
  return file.has_offsets ? read_offset_cells(file, count, size)
                          : read_counted_cells(file, count, size);
}

void read_types(File& file) {
  file.types.clear();
  for (const double type : read_numbers(file, "int", next_count(file))) {
    file.types.push_back(index_of(type));
  }
}

bool read_geometry(File& file, const std::string& word) {
  const auto* part = std::find(part_words.begin(), part_words.end(), word);
  if (word == "points") {
    read_points(file);
  } else if (word == "cells" && file.is_grid) {
    file.cells = read_cells(file);
  } else if (word == "cell_types" && file.is_grid) {
    read_types(file);
  } else if (part != part_words.end() && !file.is_grid) {
    file.parts[part - part_words.begin()] = read_cells(file);
  } else {
    return false;
  }
  return true;
}

// --- arrays -------------------------------------------------------------------------------------

void add_array(File& file, std::string_view name, std::size_t components,
               std::vector<double> values) {
  if (file.data == nullptr || components == 0) return;  // of the whole file, or of nothing
  if (components > most_components) {
    throw ReadError(fmt::format("the array '{}' has {} components", name, components));
  }
  file.data->arrays.push_back({decoded(name), static_cast<int>(components), std::move(values)});
}

// A tuple for each point or cell.
void read_array(File& file, std::string_view name, std::string_view type, std::size_t components) {
  const std::size_t count = product(file.data->count, components);
  add_array(file, name, components, read_numbers(file, type, count));
}

// From 0 to 1 in text, from 0 to 255 in binary files.
void read_colours(File& file) {
  const std::string_view name = file.source.word();
  const std::size_t components = next_count(file);
  read_array(file, name, "unsigned_char", components);
  if (file.encoding != Encoding::text || components == 0) return;
  for (double& value : file.data->arrays.back().values) value = std::floor(255.0 * value + 0.5);
}

// In text one word on each line; in binary files the length comes first, in 1, 2, 4 or 8 bytes, as
// the two highest bits say.
void skip_words(File& file, std::size_t count) {
  file.source.line();
  for (std::size_t i = 0; i < count; ++i) {
    if (file.encoding == Encoding::text) {
      file.source.line();
      continue;
    }
    const auto first = static_cast<unsigned char>(file.source.bytes(1)[0]);
    std::size_t length = first & 63U;
    for (int more = (1 << (3 - (first >> 6))) - 1; more > 0; --more) {
      length = 256 * length + static_cast<unsigned char>(file.source.bytes(1)[0]);
    }
    file.source.bytes(length);
  }
}

// What VTK knows of arrays beyond their numbers, up to an empty line.
void skip_metadata(File& file) {
  file.source.line();
  while (!file.source.is_empty()) {
    const std::string_view line = file.source.line();
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) return;
  }
}

void read_field(File& file) {
  file.source.word();  // its name
  for (std::size_t left = next_count(file); left > 0; --left) {
    std::string_view name = file.source.word();
    while (lower_case(name) == "metadata") {
      skip_metadata(file);
      name = file.source.word();
    }
    const std::size_t components = next_count(file);
    const std::size_t tuples = next_count(file);
    const std::string type = next_word(file);
    const std::size_t count = product(components, tuples);
    if (type == "string" || type == "utf8_string") {
      skip_words(file, count);
    } else {
      add_array(file, name, components, read_numbers(file, type, count));
    }
  }
}

// SCALARS name type [components], then LOOKUP_TABLE name.
void read_scalars(File& file) {
  const std::string_view name = file.source.word();
  const std::string type = next_word(file);
  NumberSource rest(file.source.line());
  const std::string_view components = rest.word();
  if (next_word(file) != "lookup_table") throw ReadError("SCALARS without a LOOKUP_TABLE");
  file.source.word();  // its name
  read_array(file, name, type, components.empty() ? 1 : count_of(components));
}

// Four bytes for each colour in binary files, four numbers in text.
void skip_lookup_table(File& file) {
  file.source.word();  // its name
  read_numbers(file, "unsigned_char", product(4, next_count(file)));
}

bool read_data(File& file, const std::string& word) {
  struct Kind {
    std::string_view word;
    std::size_t components;
  };
  constexpr std::array<Kind, 7> kinds{{{"vectors", 3},
                                       {"normals", 3},
                                       {"tensors", 9},
                                       {"tensors6", 6},
                                       {"global_ids", 1},
                                       {"pedigree_ids", 1},
                                       {"edge_flags", 1}}};
  const auto* kind =
      std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.word == word; });
  if (word == "scalars") {
    read_scalars(file);
  } else if (word == "lookup_table") {
    skip_lookup_table(file);
  } else if (word == "color_scalars") {
    read_colours(file);
  } else if (word == "texture_coordinates") {
    const std::string_view name = file.source.word();
    const std::size_t components = next_count(file);
    read_array(file, name, next_word(file), components);
  } else if (kind != kinds.end()) {
    const std::string_view name = file.source.word();
    read_array(file, name, next_word(file), kind->components);
  } else {
    return false;
  }
  return true;
}

// --- the file -----------------------------------------------------------------------------------

File read_header(const std::string& content) {
  File file{NumberSource(content)};
  const std::string first = lower_case(file.source.line());
  constexpr std::string_view start = "# vtk datafile version ";
  if (!first.starts_with(start)) throw ReadError(fmt::format("unrecognized file type: {}", first));
  file.has_offsets = first.size() > start.size() && first[start.size()] >= '5';
  file.source.line();  // the title
  const std::string encoding = next_word(file);
  if (encoding != "ascii" && encoding != "binary") {
    throw ReadError(fmt::format("unrecognized file type: {}", encoding));
  }
  file.encoding = encoding == "ascii" ? Encoding::text : Encoding::big_endian;
  const std::string word = next_word(file);
  const std::string kind = next_word(file);
  file.is_grid = kind == "unstructured_grid";
  if (word != "dataset" || (kind != "polydata" && !file.is_grid)) {
    throw ReadError(
        fmt::format("'{} {}': only polygonal data (DATASET POLYDATA) and unstructured grids can be "
                    "read",
                    word, kind));
  }
  return file;
}

void read_section(File& file, const std::string& word) {
  if (word == "metadata") {
    skip_metadata(file);
  } else if (word == "field") {
    read_field(file);
  } else if (word == "point_data" || word == "cell_data") {
    file.data = word == "point_data" ? &file.point_data : &file.cell_data;
    file.data->count = next_count(file);
  } else if (file.data != nullptr ? !read_data(file, word) : !read_geometry(file, word)) {
    throw ReadError(fmt::format("the word '{}' is not understood", word));
  }
}

File read_file(const std::string& content) {
  File file = read_header(content);
  for (std::string word = next_word(file); !word.empty(); word = next_word(file)) {
    read_section(file, word);
  }
  return file;
}

std::vector<SurfaceArray> checked(Attributes&& data, std::size_t tuples,
                                  std::vector<std::string>& notes) {
  std::vector<SurfaceArray> result;
  for (SurfaceArray& array : data.arrays) {
    if (array.name.empty()) continue;
    if (array.values.size() == tuples * array.components) {
      result.push_back(std::move(array));
      continue;
    }
    notes.push_back(fmt::format("the array '{}' was ignored: it has {} tuples instead of {}",
                                array.name, array.tuples(), tuples));
  }
  return result;
}

void check_types(const File& file) {
  if (!file.is_grid || file.types.size() == file.cells.size()) return;
  throw ReadError(fmt::format("{} cells, but {} cell types", file.cells.size(), file.types.size()));
}

/// \returns the number of cells.
std::size_t add_cells(File& file, VtkCells& cells) {
  check_types(file);
  for (std::size_t i = 0; i < file.cells.size(); ++i) {
    cells.add(file.types[i], std::move(file.cells[i]));
  }
  std::size_t count = file.cells.size();
  for (std::size_t k = 0; k < file.parts.size(); ++k) {
    for (std::vector<int>& corners : file.parts[k]) cells.add(part_types[k], std::move(corners));
    count += file.parts[k].size();
  }
  return count;
}

}  // namespace

PolygonSoup parse_legacy_vtk(const std::string& content) {
  File file = read_file(content);
  PolygonSoup soup;
  VtkCells cells;
  const std::size_t cell_count = add_cells(file, cells);
  cells.move_to(soup);
  soup.point_arrays = checked(std::move(file.point_data), file.points.size(), soup.notes);
  soup.polygon_arrays =
      follow(checked(std::move(file.cell_data), cell_count, soup.notes), cells.cell_of_polygon());
  soup.points = std::move(file.points);
  return soup;
}

VtkGrid parse_legacy_vtk_grid(const std::string& content) {
  File file = read_file(content);
  check_types(file);
  VtkGrid grid{std::move(file.points), std::move(file.cells), std::move(file.types)};
  for (std::size_t k = 0; k < file.parts.size(); ++k) {
    for (std::vector<int>& corners : file.parts[k]) {
      grid.cells.push_back(std::move(corners));
      grid.types.push_back(part_types[k]);
    }
  }
  return grid;
}

}  // namespace hexwall
