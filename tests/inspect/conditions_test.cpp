// The conditions of hexwall quality --fail-if.

#include "inspect/conditions.h"

#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace hexwall::test {
namespace {

bool holds_for(const std::string& text, double value) {
  return holds(parse_condition(text), {{"other", -1.0}, {"min_skew", value}});
}

TEST(Conditions, Compare) {
  EXPECT_TRUE(holds_for("min_skew<0.2", 0.19));
  EXPECT_FALSE(holds_for("min_skew<0.2", 0.2));
  EXPECT_TRUE(holds_for("min_skew <= 0.2", 0.2));
  EXPECT_TRUE(holds_for(" min_skew\t>1e-3 ", 0.2));
  EXPECT_FALSE(holds_for("min_skew>0.2", 0.2));
  EXPECT_TRUE(holds_for("min_skew>=.2", 0.2));
  EXPECT_TRUE(holds_for("min_skew==-3", -3.0));
  EXPECT_FALSE(holds_for("min_skew==-3", 3.0));
}

TEST(Conditions, AreRefusedIfTheyAreNone) {
  for (const char* text : {"", "min_skew", "<0.2", "min_skew<", "min_skew<x", "min_skew=0.2",
                           "min_skew<<1", "min_skew<0.2 or so"}) {
    expect_error(ExitCode::usage, {text, "NAME OP NUMBER"}, [&] { parse_condition(text); });
  }
  expect_error(ExitCode::usage, {"no figure 'max_skew'", "other min_skew"}, [] {
    holds(parse_condition("max_skew<1"), {{"other", 1.0}, {"min_skew", 2.0}});
  });
}

}  // namespace
}  // namespace hexwall::test
