#include "layer_options.h"

#include "core/errors.h"
#include "input_options.h"
#include "surface/read_points.h"
#include "surface/scattered.h"

namespace hexwall {
namespace {

void add_thickness_options(CLI::App& command, const std::string& group, LayerCommandOptions& o) {
  CLI::Option* constant =
      command.add_option("--thickness", o.layers.thickness,
                         "Thickness of all layers together, in input units [out: 10 % of the mean "
                         "radius; in: 15 % of the local radius]");
  CLI::Option* ratio = command.add_option("--thickness-ratio", o.layers.thickness_ratio,
                                          "Thickness as a fraction of the local vessel radius");
  CLI::Option* array = command.add_option("--thickness-array", o.thickness_array,
                                          "Point array of the input with the thickness");
  CLI::Option* file = command.add_option(
      "--thickness-file", o.thickness_file,
      "File of scattered thicknesses, x y z thickness on each line, to be interpolated");
  for (CLI::Option* option : {constant, ratio, array, file}) {
    option->group(group);
    for (CLI::Option* other : {constant, ratio, array, file}) {
      if (other != option) option->excludes(other);
    }
  }
  command.add_option("--thickness-min", o.layers.thickness_min, "Least thickness asked")
      ->group(group);
  command.add_option("--thickness-max", o.layers.thickness_max, "Greatest thickness asked")
      ->group(group);
  command
      .add_flag("--thickness-strict", o.strict,
                "Refuse, instead of a warning, where layers have to be thinner than asked")
      ->group(group);
}

void add_inner_options(CLI::App& command, const std::string& group, LayerCommandOptions& o) {
  CLI::Option* thickness = command.add_option("--inner-thickness", o.inner.thickness,
                                              "With --side both: thickness in the lumen");
  CLI::Option* ratio =
      command.add_option("--inner-thickness-ratio", o.inner.thickness_ratio,
                         "With --side both: the same as a fraction of the local radius [0.15]");
  thickness->excludes(ratio)->group(group);
  ratio->excludes(thickness)->group(group);
  command
      .add_option("--inner-layers", o.inner.layers, "With --side both: hexes through the lumen's")
      ->capture_default_str()
      ->group(group);
  command
      .add_option("--inner-growth", o.inner.growth,
                  "With --side both: height ratio of successive layers, from the wall inward")
      ->capture_default_str()
      ->group(group);
}

}  // namespace

void add_layer_options(CLI::App& command, LayerCommandOptions& o) {
  const std::string group = "Layers";
  command
      .add_option("--side", o.side,
                  "out: the vessel's wall; in: near-wall layers in the lumen; both: one conforming "
                  "mesh of two regions")
      ->check(CLI::IsMember({"out", "in", "both"}))
      ->capture_default_str()
      ->group(group);
  add_thickness_options(command, group, o);
  CLI::Option* layers =
      command.add_option("--layers", o.layers.layers, "Hexes through the thickness")
          ->capture_default_str()
          ->group(group);
  CLI::Option* growth = command
                            .add_option("--growth", o.layers.growth,
                                        "Height ratio of successive layers, from the surface away")
                            ->capture_default_str()
                            ->group(group);
  command
      .add_option("--layer-spec", o.layer_spec,
                  "Named layers from the surface away, name:share:hexes separated by commas: "
                  "intima:0.15:1,media:0.55:2,adventitia:0.30:1")
      ->excludes(layers)
      ->excludes(growth)
      ->group(group);
  add_inner_options(command, group, o);
}

void set_layer_options(const LayerCommandOptions& o, const ReadResult& read,
                       const TriangleSurface& prepared, PipelineOptions& pipeline) {
  const LayerOptions defaults;
  if (o.side != "both" &&
      (o.inner.thickness || o.inner.thickness_ratio || o.inner.layers != defaults.layers ||
       o.inner.growth != defaults.growth)) {
    throw UsageError("the options --inner-... go with --side both; --side in takes the others");
  }
  LayerOptions layers = o.layers;
  if (!o.thickness_array.empty()) {
    layers.thickness_field = point_values(read, o.thickness_array, prepared);
  } else if (!o.thickness_file.empty()) {
    layers.thickness_field =
        interpolate_scattered(read_point_values(o.thickness_file), prepared.points);
  }
  if (!o.layer_spec.empty()) layers.groups = parse_layers(o.layer_spec);
  pipeline.outward.reset();
  pipeline.inward.reset();
  if (o.side != "in") pipeline.outward = layers;
  if (o.side == "in") pipeline.inward = layers;
  if (o.side == "both") pipeline.inward = o.inner;
  pipeline.thickness_strict = o.strict;
}

}  // namespace hexwall
