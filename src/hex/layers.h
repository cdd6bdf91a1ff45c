#pragma once

#include <string>
#include <vector>

namespace hexwall {

/// Layers of hexes of equal height that form one named cell zone.
struct LayerGroup {
  std::string name;
  double share = 1.0;  ///< of the thickness, relative to the other groups' shares; > 0
  int cells = 1;       ///< hexes through the group; >= 1
};

/// One group a layer, `layers` of them, whose heights grow by the ratio `growth` away from the
/// surface. Names are `prefix` and 1, 2, … \pre layers >= 1, growth > 0.
std::vector<LayerGroup> graded_layers(int layers, double growth, const std::string& prefix);

/// All layers of a wall from the innermost to the outermost. Levels are heights along a column of
/// hexes: -1 at the inner skin, 0 on the surface, 1 at the outer skin.
struct LayerPlan {
  std::vector<double> levels;           ///< #layers + 1, rising; one of them is 0
  std::vector<int> zone;                ///< #layers index into `zone_names`
  std::vector<std::string> zone_names;  ///< from the innermost to the outermost
  int inner = 0;                        ///< layers on the inner side of the surface

  int layers() const { return static_cast<int>(zone.size()); }
  bool has_outer() const { return inner < layers(); }

  /// The levels of one side, 0 included.
  std::vector<double> outer_levels() const;
  std::vector<double> inner_levels() const;
};

/// \param outward, inward groups from the surface away; either may be empty, not both.
LayerPlan plan_layers(const std::vector<LayerGroup>& outward,
                      const std::vector<LayerGroup>& inward);

/// Reads `intima:0.15:1,media:0.55:2`: name, share of the thickness, hexes, from the surface away.
/// \throws UsageError, naming the part, if a part has another form, a number is not positive, a
/// name is not valid for a cell zone or occurs twice.
std::vector<LayerGroup> parse_layers(const std::string& text);

}  // namespace hexwall
