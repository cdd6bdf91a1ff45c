#include "exporters/openfoam_fields.h"

#include <algorithm>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/errors.h"
#include "exporters/foam_file.h"
#include "exporters/text.h"

namespace hexwall {
namespace {

void append(Text& text, const std::vector<Vec3>& vectors) {
  text << static_cast<int>(vectors.size()) << "\n(\n";
  for (const Vec3& v : vectors) text << '(' << v.x() << ' ' << v.y() << ' ' << v.z() << ")\n";
  text << ")\n";
}

const FlowOutlet* outlet_named(const FlowSetup& setup, const std::string& patch) {
  const auto found = std::find_if(setup.outlets.begin(), setup.outlets.end(),
                                  [&](const FlowOutlet& outlet) { return outlet.patch == patch; });
  return found == setup.outlets.end() ? nullptr : &*found;
}

enum class Role { wall, inlet, flow_outlet, pressure_outlet };

Role role_of(const CellPatch& patch, const FlowSetup& setup) {
  if (patch.name == setup.inlet) return Role::inlet;
  if (const FlowOutlet* outlet = outlet_named(setup, patch.name))
    return outlet->fixes_pressure ? Role::pressure_outlet : Role::flow_outlet;
  if (patch.is_wall) return Role::wall;
  throw Error(ExitCode::internal,
              "no boundary value for the patch '" + patch.name + "': it is no wall and no opening");
}

std::string field(std::string_view foam_class, std::string_view name, std::string_view dimensions,
                  std::string_view internal, std::string_view patches) {
  return foam_header(foam_class, "0", name) +
         fmt::format(
             "dimensions      {};\n\ninternalField   uniform {};\n\nboundaryField\n{{\n{}}}\n",
             dimensions, internal, patches);
}

/// Times at which a table has entries: those of one cycle, over all cycles.
void append_flow_rate(Text& text, const FlowSetup& setup, double share) {
  if (!setup.pulse) {
    text << "constant " << share * setup.flow_rate;
    return;
  }
  const Pulse& pulse = *setup.pulse;
  text << "table\n        (\n";
  for (int cycle = 0; cycle < pulse.cycles; ++cycle) {
    for (std::size_t i = cycle == 0 ? 0 : 1; i < pulse.times.size(); ++i) {
      text << "            (" << fmt::format("{:.10g}", cycle * pulse.period + pulse.times[i])
           << ' ' << share * pulse.flows[i] << ")\n";
    }
  }
  text << "        )";
}

void append_inlet(Text& text, const FlowSetup& setup) {
  if (setup.pulse) {
    text << "        type            timeVaryingMappedFixedValue;\n"
            "        mapMethod       nearest;\n"
            "        setAverage      off;\n"
            "        offset          (0 0 0);\n";
  } else {
    text << "        type            fixedValue;\n";
  }
  text << "        value           nonuniform List<vector>\n";
  append(text, setup.pulse ? setup.pulse->velocities.front() : setup.inlet_velocities);
  text << ";\n";
}

OutputFile velocity_file(const CellMesh& mesh, const FlowSetup& setup) {
  Text text(64 * setup.inlet_velocities.size() + 4096);
  for (const CellPatch& patch : mesh.patches) {
    text << "    " << patch.name << "\n    {\n";
    switch (role_of(patch, setup)) {
      case Role::wall:
        text << "        type            noSlip;\n";
        break;
      case Role::inlet:
        append_inlet(text, setup);
        break;
      case Role::flow_outlet:
        text << "        type            flowRateOutletVelocity;\n        volumetricFlowRate ";
        append_flow_rate(text, setup, outlet_named(setup, patch.name)->share);
        text << ";\n        value           uniform (0 0 0);\n";
        break;
      case Role::pressure_outlet:
        // What flows back, in a pulse, comes in at rest.
        text << "        type            inletOutlet;\n"
                "        inletValue      uniform (0 0 0);\n"
                "        value           uniform (0 0 0);\n";
        break;
    }
    text << "    }\n";
  }
  return {"0/U", field("volVectorField", "U", "[0 1 -1 0 0 0 0]", "(0 0 0)", text.take())};
}

OutputFile pressure_file(const CellMesh& mesh, const FlowSetup& setup) {
  Text text(4096);
  for (const CellPatch& patch : mesh.patches) {
    const bool is_fixed = role_of(patch, setup) == Role::pressure_outlet;
    text << "    " << patch.name << "\n    {\n"
         << (is_fixed ? "        type            fixedValue;\n        value           uniform 0;\n"
                      : "        type            zeroGradient;\n")
         << "    }\n";
  }
  return {"0/p", field("volScalarField", "p", "[0 2 -2 0 0 0 0]", "0", text.take())};
}

/// What timeVaryingMappedFixedValue reads: the faces' centres, and their velocities at each time.
/// It knows no cycles, so every cycle has its files.
std::vector<OutputFile> boundary_data(const FlowSetup& setup) {
  const Pulse& pulse = *setup.pulse;
  const std::string folder = "constant/boundaryData/" + setup.inlet;
  const auto list = [](const std::vector<Vec3>& vectors) {
    Text text(64 * vectors.size() + 64);
    append(text, vectors);
    return text.take();
  };
  std::vector<OutputFile> files{{folder + "/points", list(setup.inlet_face_centers)}};
  for (int cycle = 0; cycle < pulse.cycles; ++cycle) {
    for (std::size_t i = cycle == 0 ? 0 : 1; i < pulse.times.size(); ++i) {
      const double time = cycle * pulse.period + pulse.times[i];
      files.push_back({fmt::format("{}/{:.10g}/U", folder, time), list(pulse.velocities[i])});
    }
  }
  return files;
}

}  // namespace

std::vector<OutputFile> openfoam_fields(const CellMesh& mesh, const FlowSetup& setup) {
  std::vector<OutputFile> files{velocity_file(mesh, setup), pressure_file(mesh, setup)};
  if (!setup.pulse) return files;
  for (OutputFile& file : boundary_data(setup)) files.push_back(std::move(file));
  return files;
}

}  // namespace hexwall
