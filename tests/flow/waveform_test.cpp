// Waveforms of the flow rate and their harmonics.

#include "flow/waveform.h"

#include <cmath>
#include <fstream>
#include <numbers>

#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace hexwall {
namespace {

using std::numbers::pi;

std::filesystem::path file_with(const TemporaryFolder& folder, const std::string& text) {
  std::ofstream(folder / "flow.txt") << text;
  return folder / "flow.txt";
}

void expect_refused(ExitCode code, const std::string& text,
                    std::initializer_list<const char*> words) {
  const TemporaryFolder folder;
  const auto path = file_with(folder, text);
  test::expect_error(code, words, [&] { read_waveform(path); });
}

TEST(Waveform, TypicalOneHasMeanOneAndIsPeriodic) {
  const Waveform w = typical_waveform(0.8);
  EXPECT_DOUBLE_EQ(w.period(), 0.8);
  EXPECT_NEAR(mean(w), 1.0, 1e-14);
  EXPECT_EQ(w.flows.front(), w.flows.back());
}

TEST(Waveform, HarmonicsOfATriangleWaveAreExact) {
  // 1 - 2|t|/T·2 … : even, with c_n = 8/(π n)² for odd n and none for even n.
  const Waveform w{{0.0, 1.0, 2.0}, {1.0, -1.0, 1.0}};
  const FourierSeries series = fourier_series(w, 6);
  ASSERT_EQ(series.coefficients.size(), 7U);
  for (int n = 0; n <= 6; ++n) {
    const double expected = n % 2 == 1 ? 8.0 / std::pow(pi * n, 2) : 0.0;
    EXPECT_NEAR(std::abs(series.coefficients[n] - expected), 0.0, 1e-14) << n;
  }
}

TEST(Waveform, SeriesConvergesToTheTable) {
  const Waveform w = typical_waveform(1.0);
  EXPECT_LT(deviation(fourier_series(w, 16), w), 0.025);
  EXPECT_GT(deviation(fourier_series(w, 2), w), 0.05);
  EXPECT_NEAR(fourier_series(w, 200)(0.2), w.flows[4], 2e-3);
}

TEST(Waveform, IsReadWithCommentsAndCommas) {
  const TemporaryFolder folder;
  const Waveform w =
      read_waveform(file_with(folder, "# t Q\n0, 1\n\n0.25 3 # peak\n0.5\t2\n0.9 1.001\n"));
  EXPECT_EQ(w.times, (std::vector<double>{0.0, 0.25, 0.5, 0.9}));
  EXPECT_EQ(w.flows, (std::vector<double>{1.0, 3.0, 2.0, 1.0}));
}

TEST(Waveform, RefusesWhatIsNoCycle) {
  expect_refused(ExitCode::read, "0 1\n0.5 two\n", {"flow.txt, line 2", "two"});
  expect_refused(ExitCode::read, "0 1\n0.5 2 3\n", {"line 2"});
  expect_refused(ExitCode::read, "0 1\n0.5 nan\n1 1\n", {"line 2"});
  expect_refused(ExitCode::read, "0.1 1\n0.5 2\n1 1\n", {"line 1", "must be 0"});
  expect_refused(ExitCode::read, "0 1\n0.5 2\n0.4 2\n1 1\n", {"line 3", "must rise"});
  expect_refused(ExitCode::read, "0 1\n1 1\n", {"three rows"});
  expect_refused(ExitCode::read, "0 1\n0.5 2\n1 1.5\n", {"repeat the first", "add a row"});
  expect_refused(ExitCode::usage, "0 -1\n0.5 -2\n1 -1\n", {"mean flow rate is -1.5"});
  test::expect_error(ExitCode::read, {"cannot open", "/nowhere"},
                     [] { read_waveform("/nowhere"); });
}

}  // namespace
}  // namespace hexwall
