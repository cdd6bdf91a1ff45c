// How the share of the work and the time left are estimated.

#include <gtest/gtest.h>

#include "tools/progress_display.h"

namespace hexwall::test {
namespace {

TEST(Progress, EstimatesFromTheStagesThatAreOver) {
  ProgressEstimate estimate({{"first", 1.0}, {"second", 3.0}, {"third", 1.0}});
  estimate.begin("first", 0.0);
  EXPECT_EQ(estimate.fraction(1.0), 0.0);
  EXPECT_LT(estimate.remaining(1.0), 0.0);  // not known yet
  estimate.begin("second", 2.0);            // two seconds for a weight of 1
  EXPECT_NEAR(estimate.fraction(2.0), 0.2, 1e-12);
  EXPECT_NEAR(estimate.remaining(2.0), 8.0, 1e-12);
  EXPECT_NEAR(estimate.fraction(5.0), 0.5, 1e-12);
  EXPECT_NEAR(estimate.remaining(5.0), 5.0, 1e-12);
  estimate.begin("third", 8.0);
  EXPECT_NEAR(estimate.fraction(8.0), 0.8, 1e-12);
  EXPECT_NEAR(estimate.remaining(8.0), 2.0, 1e-12);
  EXPECT_EQ(estimate.number(), 3);
}

TEST(Progress, NeverFallsAndIsNeverOverBeforeTheEnd) {
  ProgressEstimate estimate({{"first", 1.0}, {"second", 1.0}});
  estimate.begin("first", 0.0);
  estimate.begin("second", 1.0);
  EXPECT_NEAR(estimate.fraction(100.0), 0.975, 1e-12);
  EXPECT_GT(estimate.remaining(100.0), 5.0);  // it is late: who knows for how long
  estimate.begin("first", 100.0);             // again, with other poles
  EXPECT_NEAR(estimate.fraction(100.0), 0.975, 1e-12);
  estimate.begin("unheard of", 101.0);
  EXPECT_EQ(estimate.number(), 1);
}

}  // namespace
}  // namespace hexwall::test
