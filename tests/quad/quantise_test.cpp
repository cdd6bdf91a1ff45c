#include "quad/quantise.h"

#include <random>

#include <gtest/gtest.h>

#include "foliation/row_spacing.h"
#include "holomorphic/solution.h"
#include "surface/generate.h"

namespace hexwall {
namespace {

// The foliation of the shape with 10 loops, and rows at a size.
class Rounding : public testing::Test {
 protected:
  void SetUp() override {
    surface_ = generate_shape(Shape::aaa, 2.0);
    mesh_ = connectivity_of(surface_);
    const Eigen::VectorXd edge = Eigen::VectorXd::Ones(mesh_.face_count());
    solution_ = solve_form({surface_, mesh_, edge});
    foliation_ = foliate(solution_.connectivity, solution_.form);
  }

  Quantisation rounded(double size, const std::vector<int>& poles) const {
    const auto spacing = space_rows(solution_.refined.surface, solution_.connectivity,
                                    solution_.form, {solution_.scale_factor, solution_.size_ratio},
                                    foliation_.cylinders, {size, 0.5});
    QuantiseOptions options;
    options.size = size;
    options.poles = poles;
    return quantise(foliation_, spacing, options);
  }

  // Quads around a loop: those of the one cylinder that ends there.
  int around(const Quantisation& numbers, int loop) const {
    for (std::size_t c = 0; c < foliation_.cylinders.size(); ++c) {
      const Cylinder& cylinder = foliation_.cylinders[c];
      if (cylinder.bottom == loop || cylinder.top == loop) {
        return numbers.around(foliation_.strips, static_cast<int>(c));
      }
    }
    return -1;
  }

  TriangleSurface surface_;
  Connectivity mesh_;
  FormSolution solution_;
  Foliation foliation_;
};

TEST_F(Rounding, GivesPolesMultiplesOfFour) {
  const int loops = static_cast<int>(mesh_.loops().size());
  ASSERT_EQ(foliation_.boundary_half_zeros(), 0);
  std::mt19937 random(3);
  for (int trial = 0; trial < 40; ++trial) {
    // Any set of loops but all of them: up to loops - 1 poles in a row share strips.
    std::vector<int> poles;
    for (int loop = 0; loop < loops; ++loop) {
      if (loop != trial % loops && random() % 4 != 0) poles.push_back(loop);
    }
    const Quantisation numbers = rounded(0.4 + 0.1 * trial, poles);
    for (const int loop : poles) {
      EXPECT_EQ(around(numbers, loop) % 4, 0) << "trial " << trial << ", loop " << loop;
      EXPECT_GE(around(numbers, loop), 4);
    }
    for (const int count : numbers.across) EXPECT_GE(count, 1);
    for (const int count : numbers.along) EXPECT_GE(count, 1);
  }
}

TEST_F(Rounding, StaysNearTheCircumferencesAskedFor) {
  for (const double size : {0.3, 0.6, 1.2}) {
    const Quantisation free = rounded(size, {});
    const Quantisation poles = rounded(size, {1, 4, 7});
    for (std::size_t s = 0; s < free.across.size(); ++s) {
      EXPECT_LE(std::abs(free.across[s] - poles.across[s]), 4) << "strip " << s;
    }
  }
}

}  // namespace
}  // namespace hexwall
