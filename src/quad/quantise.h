#pragma once

#include <vector>

#include "foliation/foliation.h"
#include "foliation/row_spacing.h"

namespace hexwall {

struct QuantiseOptions {
  double size = 1.0;       ///< target edge length in the (x, y) plane
  double stretch = 1.0;    ///< height of a row over the width of a column
  int fewest_around = 8;   ///< quads around any cylinder
  std::vector<int> poles;  ///< loops that take a multiple of 4 quads around
};

/// Integers for strips and cylinders. Any positive choice gives a conforming all-quad mesh; poles
/// alone ask for more: a square grid closes them.
struct Quantisation {
  std::vector<int> across;  ///< per strip: quads across, >= 1
  std::vector<int> along;   ///< per cylinder: quads along, >= 1

  int around(const Strips& strips, int cylinder) const;  ///< quads around a cylinder
  long quad_count(const Strips& strips) const;
};

/// Rounds strip widths and numbers of rows: a local search over single and paired steps of +-1 on
/// the sum of squared relative errors of the circumferences (weighted 4:1) and of the strips, with
/// at least `fewest_around` quads around cylinders and 3 along openings. What
/// poles still lack is then passed on along strips to a loop that is no pole, which always exists.
Quantisation quantise(const Foliation& foliation, const std::vector<RowSpacing>& spacing,
                      const QuantiseOptions& options);

}  // namespace hexwall
