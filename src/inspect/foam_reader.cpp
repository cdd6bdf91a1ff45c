// OpenFOAM meshes in text: the files points, faces, owner and neighbour of a polyMesh folder.

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/errors.h"
#include "inspect/foam_cells.h"
#include "inspect/read_mesh.h"
#include "surface/file_content.h"

namespace hexwall {
namespace {

namespace fs = std::filesystem;

/// Words, numbers and brackets of a file, without its comments.
class FoamTokens {
 public:
  explicit FoamTokens(std::string_view text) : rest_(text) {}

  /// The next token, empty at the end.
  std::string_view next() {
    skip_blanks();
    if (rest_.empty()) return {};
    constexpr std::string_view marks = "(){};";
    std::size_t size = 1;
    if (rest_[0] == '"') {
      size = std::min(rest_.find('"', 1), rest_.size() - 1) + 1;
    } else if (marks.find(rest_[0]) == std::string_view::npos) {
      size = std::min(rest_.find_first_of(" \t\r\n(){};\""), rest_.size());
    }
    return take(size);
  }

  void expect(std::string_view mark) {
    const std::string_view token = next();
    if (token != mark) fail(fmt::format("'{}' is expected, not '{}'", mark, token));
  }

  template <typename Number>
  Number number() {
    const std::string_view token = next();
    Number value{};
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (token.empty()) fail("the file is truncated");
    if (error != std::errc{} || end != token.data() + token.size()) {
      fail(fmt::format("'{}' is not a number of the expected kind", token));
    }
    return value;
  }

  int count() {
    const int n = number<int>();
    if (n < 0) fail(fmt::format("{} is no count", n));
    return n;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw ReadError(fmt::format("line {}: {}", line_, message));
  }

 private:
  std::string_view take(std::size_t size) {
    const std::string_view taken = rest_.substr(0, size);
    line_ += static_cast<int>(std::count(taken.begin(), taken.end(), '\n'));
    rest_.remove_prefix(std::min(size, rest_.size()));
    return taken;
  }

  void skip_blanks() {
    for (;;) {
      take(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size()));
      if (rest_.starts_with("//")) {
        take(std::min(rest_.find('\n'), rest_.size()));
      } else if (rest_.starts_with("/*")) {
        const std::size_t end = rest_.find("*/", 2);
        if (end == std::string_view::npos) fail("a comment does not end");
        take(end + 2);
      } else {
        return;
      }
    }
  }

  std::string_view rest_;
  int line_ = 1;
};

// The dictionary FoamFile, up to its closing brace.
void read_header(FoamTokens& tokens) {
  if (tokens.next() != "FoamFile") tokens.fail("the file does not begin with FoamFile");
  tokens.expect("{");
  for (std::string_view token = tokens.next(); token != "}"; token = tokens.next()) {
    if (token.empty()) tokens.fail("the file is truncated");
    if (token != "format") continue;
    if (tokens.next() == "binary") {
      tokens.fail(
          "the mesh is binary, which cannot be read. Write it as text: set writeFormat ascii in "
          "system/controlDict and run foamFormatConvert -constant");
    }
  }
}

// A list of `count` items in brackets, each read by `item`.
template <typename Item>
void read_list(FoamTokens& tokens, const Item& item) {
  const int count = tokens.count();
  tokens.expect("(");
  for (int i = 0; i < count; ++i) item();
  tokens.expect(")");
}

std::vector<Vec3> read_points(FoamTokens& tokens) {
  std::vector<Vec3> points;
  read_list(tokens, [&] {
    tokens.expect("(");
    Vec3 p;
    for (double& x : p) x = tokens.number<double>();
    points.push_back(p);
    tokens.expect(")");
  });
  return points;
}

std::vector<std::vector<int>> read_faces(FoamTokens& tokens) {
  std::vector<std::vector<int>> faces;
  read_list(tokens, [&] {
    std::vector<int>& face = faces.emplace_back();
    read_list(tokens, [&] { face.push_back(tokens.number<int>()); });
    if (face.size() < 3) tokens.fail(fmt::format("a face has {} vertices", face.size()));
  });
  return faces;
}

// Also written as N{value} if all are equal. There can't be more than `most`.
std::vector<int> read_labels(FoamTokens& tokens, std::size_t most) {
  std::vector<int> labels;
  const int count = tokens.count();
  if (static_cast<std::size_t>(count) > most) {
    tokens.fail(fmt::format("{} labels of {} faces", count, most));
  }
  const std::string_view mark = tokens.next();
  if (mark == "{") {
    labels.assign(static_cast<std::size_t>(count), tokens.number<int>());
    tokens.expect("}");
    return labels;
  }
  if (mark != "(") tokens.fail(fmt::format("'(' is expected, not '{}'", mark));
  for (int i = 0; i < count; ++i) labels.push_back(tokens.number<int>());
  tokens.expect(")");
  return labels;
}

template <typename Read>
auto read_file(const std::string& content, const char* file, const Read& read) {
  try {
    FoamTokens tokens(content);
    read_header(tokens);
    return read(tokens);
  } catch (const ReadError& error) {
    throw ReadError(fmt::format("{}: {}", file, error.what()));
  }
}

std::string content_in(const fs::path& folder, const char* file) {
  try {
    const fs::path path = folder / file;
    if (!fs::exists(path) && fs::exists(path.string() + ".gz")) {
      throw ReadError("the file is compressed: unpack it with gunzip");
    }
    check_file(path);
    return content_of(path);
  } catch (const ReadError& error) {
    throw ReadError(fmt::format("{}: {}", file, error.what()));
  }
}

}  // namespace

AnyMesh read_foam(const fs::path& folder) {
  return parse_foam({content_in(folder, "points"), content_in(folder, "faces"),
                     content_in(folder, "owner"), content_in(folder, "neighbour")});
}

AnyMesh parse_foam(const FoamFiles& files) {
  AnyMesh mesh;
  mesh.points = read_file(files.points, "points", read_points);
  const auto faces = read_file(files.faces, "faces", read_faces);
  const auto labels = [&](FoamTokens& tokens) { return read_labels(tokens, faces.size()); };
  const auto owner = read_file(files.owner, "owner", labels);
  const auto neighbour = read_file(files.neighbour, "neighbour", labels);
  if (owner.size() != faces.size()) {
    throw ReadError(fmt::format("{} faces, but {} owners", faces.size(), owner.size()));
  }
  FaceMesh sides;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    sides.add(faces[f], owner[f], f < neighbour.size() ? neighbour[f] : -1);
  }
  add_cells(std::move(sides), mesh);
  return mesh;
}

}  // namespace hexwall
