#include "exporters/view_data.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>
#include <vtkBase64Utilities.h>
#include <vtkNew.h>

#include "core/errors.h"
#include "exporters/view_frame.h"
#include "exporters/zlib_compressor.h"
#include "hex/cell_faces.h"

namespace hexwall {
namespace {

using Json = nlohmann::ordered_json;

/// The data, grown block by block, and what it consists of.
class Blocks {
 public:
  template <typename Value>
  void add(const std::string& name, const char* type, const std::vector<Value>& values) {
    const std::size_t at = bytes_.size();
    const std::size_t size = values.size() * sizeof(Value);
    bytes_.resize(at + (size + 3) / 4 * 4, '\0');  // blocks begin at multiples of four
    if (size > 0) std::memcpy(bytes_.data() + at, values.data(), size);
    list_.push_back({{"name", name}, {"type", type}, {"count", values.size()}});
  }
  void add(const std::string& name, const std::vector<float>& values) { add(name, "f32", values); }
  void add(const std::string& name, const std::vector<std::uint8_t>& values) {
    add(name, "u8", values);
  }
  void add(const std::string& name, const std::vector<std::uint32_t>& values) {
    add(name, "u32", values);
  }

  const Json& list() const { return list_; }

  std::string base64() const {
    vtkNew<ZlibCompressor> zlib;
    zlib->SetCompressionLevel(6);
    std::vector<unsigned char> packed(zlib->GetMaximumCompressionSpace(bytes_.size()));
    const auto* from = reinterpret_cast<const unsigned char*>(bytes_.data());
    const std::size_t size = zlib->Compress(from, bytes_.size(), packed.data(), packed.size());
    if (size == 0) throw Error(ExitCode::internal, "the data of the 3-D view can't be compressed");
    std::string text((size + 2) / 3 * 4, '\0');
    auto* to = reinterpret_cast<unsigned char*>(text.data());
    const unsigned long length = vtkBase64Utilities::Encode(packed.data(), size, to);
    text.resize(length);
    return text;
  }

 private:
  std::string bytes_;
  Json list_ = Json::array();
};

Eigen::Matrix3Xd matrix_of(const std::vector<Vec3>& points) {
  Eigen::Matrix3Xd matrix(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    matrix.col(static_cast<Eigen::Index>(i)) = points[i];
  }
  return matrix;
}

std::vector<float> around_middle(const std::vector<Vec3>& points) {
  const Eigen::Matrix3Xd all = matrix_of(points);
  const Vec3 middle = 0.5 * (all.rowwise().minCoeff() + all.rowwise().maxCoeff());
  std::vector<float> values;
  values.reserve(3 * points.size());
  for (const Vec3& p : points) {
    for (const double x : Vec3(p - middle)) values.push_back(static_cast<float>(x));
  }
  return values;
}

// Each corner as the difference to the same one of the cell before, which compresses well.
std::vector<std::uint32_t> differences(std::span<const int> corners, std::size_t per_cell) {
  std::vector<std::uint32_t> values(corners.begin(), corners.end());
  for (std::size_t i = per_cell; i < values.size(); ++i) {
    values[i] -= static_cast<std::uint32_t>(corners[i - per_cell]);
  }
  return values;
}

std::vector<float> floats(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

/// What the mesh can be coloured by.
class Arrays {
 public:
  explicit Arrays(Blocks& blocks) : blocks_(blocks) {}

  void add_groups(const std::string& name, const std::string& title,
                  const std::vector<CellGroup>& groups, const std::vector<int>& group) {
    Json labels = Json::array();
    for (const CellGroup& g : groups) labels.push_back(g.name);
    blocks_.add(name, std::vector<std::uint8_t>(group.begin(), group.end()));
    list_.push_back({{"name", name}, {"title", title}, {"on", "cells"}, {"labels", labels}});
  }

  void add(const std::string& name, const std::string& title, const char* on,
           const std::vector<double>& values, const std::optional<std::array<double, 2>>& range) {
    blocks_.add(name, floats(values));
    list_.push_back({{"name", name}, {"title", title}, {"on", on}});
    if (range) list_.back()["range"] = *range;
  }

  void add_side(const std::string& prefix, const std::string& title, const ThicknessResult& side) {
    std::vector<double> ratio;
    for (int v = 0; v < static_cast<int>(side.given.size()); ++v) ratio.push_back(side.ratio(v));
    add(prefix + "thickness", title + " thickness", "points", side.given, std::nullopt);
    add(prefix + "thickness_ratio", title + " thickness given / asked", "points", ratio,
        std::array{0.0, 1.0});
  }

  const Json& list() const { return list_; }

 private:
  Blocks& blocks_;
  Json list_ = Json::array();
};

}  // namespace

ViewData view_data(const PipelineResult& r, std::size_t most_hexes) {
  const bool has_hexes = r.wall.shape.size() <= most_hexes;
  Blocks blocks;
  blocks.add("points", around_middle(has_hexes ? r.wall.points : r.quads.points));
  Arrays arrays(blocks);
  constexpr std::array unit_range{0.0, 1.0};
  if (has_hexes) {
    blocks.add("corners", differences(r.wall.connectivity, 8));
    arrays.add_groups("zone", "layer or zone", r.wall.zones, group_of_cells(r.wall, r.wall.zones));
    if (r.wall.regions.size() > 1) {
      arrays.add_groups("region", "region", r.wall.regions, group_of_cells(r.wall, r.wall.regions));
    }
    arrays.add("scaled_jacobian", "scaled Jacobian", "cells", r.wall_scaled_jacobian, unit_range);
  } else {
    blocks.add("corners", differences({r.quads.quads.front().data(), 4 * r.quads.quads.size()}, 4));
    arrays.add("scaled_jacobian", "scaled Jacobian of the quads", "cells",
               r.quad_quality.scaled_jacobian, unit_range);
  }
  if (r.outward) arrays.add_side("", "wall", *r.outward);
  if (r.inward) arrays.add_side("inner_", "lumen layers", *r.inward);
  arrays.add("radius", "local radius", "points", r.radius, std::nullopt);
  const Eigen::Matrix3d frame = frame_of_points(matrix_of(r.quads.points));
  const auto direction = [&](int column) {
    return Json::array({frame(0, column), frame(1, column), frame(2, column)});
  };
  const Json meta = {{"shape", has_hexes ? "hexahedron" : "quad"},
                     {"blocks", blocks.list()},
                     {"arrays", arrays.list()},
                     {"camera", {{"eye", direction(2)}, {"up", direction(1)}}}};
  std::string text = meta.dump();
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    text.replace(at, 1, "\\u003c");  // names can't end the element that holds the text
  }
  return {std::move(text), blocks.base64()};
}

}  // namespace hexwall
