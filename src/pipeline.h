#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "foliation/foliation.h"
#include "foliation/row_spacing.h"
#include "hex/extrude.h"
#include "hex/layers.h"
#include "hex/polish.h"
#include "hex/thickness.h"
#include "holomorphic/poles.h"
#include "holomorphic/solution.h"
#include "quad/extract.h"
#include "quad/pole_caps.h"
#include "quad/quality.h"
#include "quad/quantise.h"
#include "quad/relax.h"
#include "surface/connectivity.h"
#include "surface/loop_plane.h"
#include "surface/prepare.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// Where extra singularities go.
struct PoleRequest {
  enum class Mode { automatic, off, count, places };
  Mode mode = Mode::automatic;
  int most = 3;              ///< with `automatic`: no more than these
  int count = 0;             ///< with `count`: as many, wherever they help most
  std::vector<Vec3> places;  ///< with `places`: at the points of the surface nearest to these
};

/// The layers on one side of the surface. At most one of `thickness`, `thickness_ratio` and
/// `thickness_field` is given; without any the default of the side holds.
struct LayerOptions {
  std::optional<double> thickness;
  std::optional<double> thickness_ratio;  ///< of the local radius of the vessel
  std::vector<double> thickness_field;    ///< #V of the surface
  std::optional<double> thickness_min;    ///< bounds of what is asked
  std::optional<double> thickness_max;
  int layers = 3;
  double growth = 1.0;             ///< ratio of successive heights, away from the surface
  std::vector<LayerGroup> groups;  ///< named layers, instead of `layers` and `growth`
};

struct PipelineOptions {
  std::optional<double> size;   ///< target edge length, around the vessel if they differ; default:
                                ///< 20000 square quads, or up to 80000 for 9 around each opening
  bool size_by_radius = false;  ///< target edges proportional to the vessel's local radius, `size`
                                ///< on the mean over the surface
  double stretch = 1.0;         ///< length of quads along the vessel over their width around it
  std::vector<double> size_field;  ///< #V factors on the target edge length; empty: 1 everywhere
  std::optional<LayerOptions> outward = LayerOptions{};  ///< wall; 10 % of the mean radius thick
  std::optional<LayerOptions> inward;  ///< into the lumen; 15 % of the local radius thick
  bool thickness_strict = false;       ///< refuse where the layers have to be thinner than asked
  bool leaves_room_for_core = false;   ///< layers in the lumen let its core be filled
  double relax = 0.5;                  ///< 0 conformal sizes … 1 even sizes
  PoleRequest poles;
};

/// A boundary loop of the input, in the order of `PrepareResult::openings`.
struct Opening {
  std::string name;
  double length = 0.0;
  LoopPlane plane;
};

/// Everything that the pipeline computes, stage by stage. Lengths are in the unit of the input.
struct PipelineResult {
  PipelineOptions options;  ///< with all defaults filled in
  TriangleSurface surface;  ///< as prepared
  Connectivity connectivity;
  std::vector<Opening> openings;
  std::vector<double> relative_edge;  ///< #V target edge length over `options.size`
  FormSolution solution;              ///< its loops are the openings, then the poles
  std::vector<PoleStep> poles;
  Foliation foliation;
  std::vector<RowSpacing> spacing;
  Quantisation numbers;
  ExtractResult conformal;  ///< quads at their conformal places, poles open
  std::vector<PoleCap> pole_caps;
  QuadMesh quads;                   ///< poles closed, after relaxation and polishing
  std::vector<double> target_edge;  ///< #V of `quads`
  std::vector<int> extension;       ///< #Q opening whose flow extension it belongs to, or -1
  RelaxResult relaxation;
  std::vector<double> radius;   ///< #V of `quads`: local radius of the vessel, see local_radius.h
  int smoothed_directions = 0;  ///< quad vertices not extruded along the surface's normal
  PolishResult polishing;
  int evened_vertices = 0;            ///< see `even_out`
  int columns_without_face_tets = 0;  ///< see `has_face_tets`
  QuadQuality quad_quality;
  std::optional<ThicknessResult> outward, inward;  ///< as in `options`
  LayerPlan layers;
  HexMesh wall;
  std::vector<double> wall_scaled_jacobian;  ///< #H of `wall`
  double min_wall_scaled_jacobian = 0.0;
  std::vector<std::string> warnings;
  std::vector<StageTime> times;
};

/// Name of a loop of `result.solution`: of its opening, or pole_1, pole_2, …
std::string loop_name(const PipelineResult& result, int loop);

/// From a vessel surface to its hexahedral wall. Where no valid mesh is found with the poles that
/// were placed automatically, fewer are tried, and a warning says so.
/// \throws UsageError for options out of range, MeshingError where no valid mesh is found.
PipelineResult run_pipeline(const PrepareResult& input, const PipelineOptions& options,
                            const ProgressCallback& progress = {});

/// The same for a surface that needs no preparation (see `use_as_it_is`).
PipelineResult run_pipeline(const TriangleSurface& surface, const PipelineOptions& options,
                            const ProgressCallback& progress = {});

}  // namespace hexwall
