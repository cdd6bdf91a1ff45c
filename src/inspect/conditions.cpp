#include "inspect/conditions.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include <fmt/format.h>

#include "core/errors.h"

namespace hexwall {
namespace {

struct OperatorWord {
  std::string_view word;
  Condition::Operator op;
};

// The longer ones first: "<=" before "<".
constexpr std::array<OperatorWord, 5> operators{{{"<=", Condition::Operator::less_equal},
                                                 {">=", Condition::Operator::greater_equal},
                                                 {"==", Condition::Operator::equal},
                                                 {"<", Condition::Operator::less},
                                                 {">", Condition::Operator::greater}}};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

[[noreturn]] void refuse(const std::string& text) {
  throw UsageError(fmt::format(
      "'{}' is no condition: NAME OP NUMBER is needed with OP one of < <= > >= ==, such "
      "as min_scaled_jacobian<0.2",
      text));
}

}  // namespace

Condition parse_condition(const std::string& text) {
  const std::string_view all = text;
  const std::size_t at = all.find_first_of("<>=");
  if (at == std::string_view::npos) refuse(text);
  const auto* found = std::find_if(operators.begin(), operators.end(), [&](const auto& o) {
    return all.substr(at).starts_with(o.word);
  });
  if (found == operators.end()) refuse(text);
  Condition condition{text, std::string(trimmed(all.substr(0, at))), found->op, 0.0};
  const std::string_view digits = trimmed(all.substr(at + found->word.size()));
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), condition.number);
  const bool is_number = error == std::errc() && end == digits.data() + digits.size();
  if (condition.figure.empty() || !is_number) refuse(text);
  return condition;
}

bool holds(const Condition& condition, const Figures& figures) {
  const auto found = std::find_if(figures.begin(), figures.end(),
                                  [&](const auto& f) { return f.first == condition.figure; });
  if (found == figures.end()) {
    std::string known;
    for (const auto& figure : figures) known += " " + figure.first;
    throw UsageError(
        fmt::format("--fail-if: this mesh has no figure '{}'. It has{}", condition.figure, known));
  }
  switch (condition.op) {
    case Condition::Operator::less:
      return found->second < condition.number;
    case Condition::Operator::less_equal:
      return found->second <= condition.number;
    case Condition::Operator::greater:
      return found->second > condition.number;
    case Condition::Operator::greater_equal:
      return found->second >= condition.number;
    default:
      return found->second == condition.number;
  }
}

}  // namespace hexwall
