// Five awkward surfaces, turned, scaled, mirrored and renumbered: the same counts come out. Made
// coarser or rougher: a valid mesh comes out.

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkDecimatePro.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include "support/child_process.h"
#include "support/outcomes.h"
#include "support/result_files.h"
#include "support/surfaces.h"
#include "support/temporary_folder.h"
#include "support/vessel_surfaces.h"
#include "surface/orient.h"
#include "surface/write.h"

namespace hexwall::test {
namespace {

namespace fs = std::filesystem;

/// What is awkward about each is told in outcomes.md.
const std::vector<std::string> awkward{
    "vampy_artery_test_small.stl", "vampy_ica_artery_C0015.vtp", "vampy_left_atrium_moving.vtp",
    "openlb_bifurcation3d_closed.stl", "palabos_aneurysm_open.stl"};

struct Variant {
  const char* name;
  std::function<TriangleSurface(const TriangleSurface&)> make;
};

void PrintTo(const Variant& variant, std::ostream* out) {
  *out << variant.name;
}

TriangleSurface scaled(const TriangleSurface& surface, double factor) {
  return transformed(surface, [factor](const Vec3& p) { return Vec3(factor * p); });
}

TriangleSurface mirrored(const TriangleSurface& surface) {
  return transformed(surface, [](const Vec3& p) { return Vec3(-p.x(), p.y(), p.z()); });
}

/// Without its shift, which would take digits from small coordinates.
TriangleSurface rotated(const TriangleSurface& surface) {
  return transformed(surface, [](const Vec3& p) {
    return Vec3(rigid_motion(p) - rigid_motion({0, 0, 0}));
  });
}

TriangleSurface in_other_order(const TriangleSurface& surface) {
  std::vector<int> order;
  return shuffled(surface, 7, order);
}

/// Each vertex moved by up to 1 % of the mean edge length along each axis.
TriangleSurface noised(const TriangleSurface& surface) {
  std::mt19937_64 random(11);
  const double reach = 0.01 * mean_edge_length(surface);
  const auto unit = [&] { return 2.0 * static_cast<double>(random() >> 11) * 0x1.0p-53 - 1.0; };
  return transformed(surface, [&](const Vec3& p) {
    const double x = unit();
    const double y = unit();
    return Vec3(p + reach * Vec3(x, y, unit()));
  });
}

vtkSmartPointer<vtkPolyData> as_poly_data(const TriangleSurface& surface) {
  const vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : surface.points) points->InsertNextPoint(p.data());
  const vtkNew<vtkCellArray> cells;
  for (const auto& [a, b, c] : surface.triangles) {
    cells->InsertNextCell({a, b, c});
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

TriangleSurface as_surface(vtkPolyData* data) {
  TriangleSurface surface;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    surface.points.emplace_back(data->GetPoint(i)[0], data->GetPoint(i)[1], data->GetPoint(i)[2]);
  }
  const vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) {
    data->GetCellPoints(i, corners);
    std::array<int, 3> triangle;
    std::copy(corners->begin(), corners->end(), triangle.begin());
    surface.triangles.push_back(triangle);
  }
  return surface;
}

/// With a share of the triangles taken out; the ends and the topology stay. VTK wants all of them
/// wound alike.
TriangleSurface decimated(const TriangleSurface& surface, double share) {
  const vtkNew<vtkDecimatePro> decimate;
  decimate->SetInputData(as_poly_data(make_consistent(surface).surface));
  decimate->SetTargetReduction(share);
  decimate->PreserveTopologyOn();
  decimate->SplittingOff();
  decimate->BoundaryVertexDeletionOff();
  decimate->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  decimate->Update();
  return as_surface(decimate->GetOutput());
}

class AwkwardSurface : public testing::TestWithParam<std::tuple<std::string, Variant>> {
 protected:
  /// Meshes the variant. Nothing if the surface is not on this machine.
  void mesh() {
    const auto& [name, variant] = GetParam();
    const auto surface = load_surface(name);
    if (!surface) GTEST_SKIP() << name << " is not on this machine";
    folder_.emplace();
    const std::string file = (*folder_ / "variant.vtp").string();
    write_surface(file, variant.make(*surface));
    output_ = *folder_ / "out";
    const ChildResult result =
        run_hexwall({"mesh", file, "-o", output_.string(), "--write", "vtu"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    expect_valid_results(output_);
  }

  const Outcome& original() const { return outcome_of(std::get<0>(GetParam())); }

  std::optional<TemporaryFolder> folder_;  // one at a time: `load_surface` has its own
  fs::path output_;
};

std::string variant_name(const testing::TestParamInfo<AwkwardSurface::ParamType>& info) {
  const auto& [surface, variant] = info.param;
  return alphanumeric(surface) + "_" + variant.name;
}

class Equivalent : public AwkwardSurface {};

TEST_P(Equivalent, GivesTheSameCounts) {
  mesh();
  if (IsSkipped() || HasFatalFailure()) return;
  EXPECT_EQ(counts_of(report_in(output_)), original().counts);
}

INSTANTIATE_TEST_SUITE_P(
    , Equivalent,
    testing::Combine(
        testing::ValuesIn(awkward),
        testing::Values(Variant{"rotated", rotated}, Variant{"mirrored", mirrored},
                        Variant{"shuffled", in_other_order},
                        Variant{"in_thousandths", [](const auto& s) { return scaled(s, 1e-3); }},
                        Variant{"in_thousands", [](const auto& s) { return scaled(s, 1e3); }})),
    variant_name);

class Degraded : public AwkwardSurface {};

TEST_P(Degraded, IsMeshed) {
  mesh();
  if (IsSkipped() || HasFatalFailure()) return;
  EXPECT_EQ(counts_of(report_in(output_)).openings, original().counts.openings);
}

INSTANTIATE_TEST_SUITE_P(
    , Degraded,
    testing::Combine(
        testing::ValuesIn(awkward),
        testing::Values(Variant{"without_half", [](const auto& s) { return decimated(s, 0.5); }},
                        Variant{"a_tenth", [](const auto& s) { return decimated(s, 0.9); }},
                        Variant{"noised", noised})),
    variant_name);

}  // namespace
}  // namespace hexwall::test
