#pragma once

#include <string>
#include <vector>

#include "inspect/mesh_quality.h"

namespace hexwall {

/// NAME OP NUMBER, such as `min_scaled_jacobian<0.2` or `openfoam.nonOrthoFaces > 0`. OP is <, <=,
/// >, >= or ==; blanks around it do not matter.
struct Condition {
  enum class Operator { less, less_equal, greater, greater_equal, equal };
  std::string text;  ///< as given
  std::string figure;
  Operator op = Operator::less;
  double number = 0.0;
};

/// \throws UsageError if the text is no condition.
Condition parse_condition(const std::string& text);

/// Whether a condition holds. \throws UsageError, naming those there are, if there is no such
/// figure.
bool holds(const Condition& condition, const Figures& figures);

}  // namespace hexwall
