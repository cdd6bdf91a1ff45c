#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "foliation/level_curve.h"

namespace hexwall {
namespace {

using Values = std::vector<double>;

double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1.0p-53;
}

// Rises from 0 to 10 on the whole, with noise of the given size.
Values noisy(std::mt19937_64& random, double noise) {
  Values x(2 + random() % 60);
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = 10.0 * static_cast<double>(i) / static_cast<double>(x.size() - 1) +
           noise * (uniform(random) - 0.5);
  }
  x.front() = 0.0;
  x.back() = 10.0;
  return x;
}

TEST(MakeMonotone, LeavesSortedValuesUntouched) {
  for (const Values& sorted : {Values{0.0, 1.0}, Values{-2.0, -1.0, -1.0, 3.0}, Values{5.0}}) {
    Values x = sorted;
    EXPECT_FALSE(make_monotone(x));
    EXPECT_EQ(x, sorted);
  }
}

TEST(MakeMonotone, TakesTheMeanOfTheEnvelopes) {
  Values x{0.0, 3.0, 1.0, 4.0};
  EXPECT_TRUE(make_monotone(x));
  EXPECT_EQ(x, (Values{0.0, 2.0, 2.0, 4.0}));
}

TEST(MakeMonotone, StaysBetweenTheEnds) {
  Values x{0.0, -5.0, 9.0, 4.0};
  EXPECT_TRUE(make_monotone(x));
  EXPECT_EQ(x, (Values{0.0, 0.0, 4.0, 4.0}));
}

TEST(MakeMonotone, SortsAnyValuesAndKeepsTheEnds) {
  std::mt19937_64 random(3);
  int changed = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Values before = noisy(random, 0.1 * (trial % 60));
    Values x = before;
    changed += make_monotone(x) ? 1 : 0;
    ASSERT_EQ(x.size(), before.size());
    ASSERT_TRUE(std::is_sorted(x.begin(), x.end()));
    ASSERT_EQ(x.front(), before.front());
    ASSERT_EQ(x.back(), before.back());
    // Never farther off than the deepest fall.
    double fall = 0.0;
    double highest = before.front();
    for (const double value : before) {
      highest = std::max(highest, value);
      fall = std::max({fall, highest - value, -value, value - 10.0});
    }
    for (std::size_t i = 0; i < x.size(); ++i) ASSERT_LE(std::abs(x[i] - before[i]), fall);
    const Values once = x;
    ASSERT_FALSE(make_monotone(x));
    ASSERT_EQ(x, once);
  }
  EXPECT_GT(changed, 100);
}

TEST(MakeMonotone, DoesNotDependOnTheDirection) {
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 100; ++trial) {
    Values x = noisy(random, 3.0);
    Values mirrored(x.rbegin(), x.rend());
    for (double& value : mirrored) value = 10.0 - value;
    make_monotone(x);
    make_monotone(mirrored);
    for (std::size_t i = 0; i < x.size(); ++i) {
      ASSERT_NEAR(mirrored[x.size() - 1 - i], 10.0 - x[i], 1e-14);
    }
  }
}

TEST(MakeMonotone, CollapsesAFallingCurve) {
  Values x{2.0, 1.0, 0.0};
  EXPECT_TRUE(make_monotone(x));
  EXPECT_TRUE(std::is_sorted(x.begin(), x.end()));
  EXPECT_EQ(x.front(), 2.0);
}

TEST(MakeMonotonePeriodic, LeavesSortedValuesUntouched) {
  Values x{1.0, 2.0, 2.0, 7.0};
  const Values sorted = x;
  EXPECT_FALSE(make_monotone_periodic(x));
  EXPECT_EQ(x, sorted);
}

TEST(MakeMonotonePeriodic, SortsAnyValuesAndKeepsThePeriod) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 500; ++trial) {
    Values x = noisy(random, 0.1 * (trial % 60));
    // Values at the seam that lie outside the turn.
    x.front() = 3.0 * (uniform(random) - 0.5);
    x.back() = x.front() + 10.0;
    const bool was_sorted = std::is_sorted(x.begin(), x.end());
    EXPECT_EQ(make_monotone_periodic(x), !was_sorted);
    ASSERT_TRUE(std::is_sorted(x.begin(), x.end()));
    ASSERT_NEAR(x.back() - x.front(), 10.0, 1e-13);
    const Values once = x;
    make_monotone_periodic(x);
    for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(x[i], once[i], 1e-13);
  }
}

// The start of a closed curve has no part in the result.
TEST(MakeMonotonePeriodic, DoesNotDependOnTheStart) {
  std::mt19937_64 random(6);
  for (int trial = 0; trial < 200; ++trial) {
    const Values x = noisy(random, 4.0);
    const std::size_t size = x.size() - 1;
    const std::size_t shift = random() % size;
    Values turned;
    for (std::size_t i = 0; i <= size; ++i) {
      const std::size_t k = i + shift;
      turned.push_back(x[k % size] + (k >= size ? 10.0 : 0.0) + (k >= 2 * size ? 10.0 : 0.0));
    }
    Values a = x;
    Values b = turned;
    make_monotone_periodic(a);
    make_monotone_periodic(b);
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t k = i + shift;
      ASSERT_NEAR(b[i], a[k % size] + (k >= size ? 10.0 : 0.0), 1e-12);
    }
  }
}

}  // namespace
}  // namespace hexwall
