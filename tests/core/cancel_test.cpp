// Work that is no longer wanted ends soon, wherever it is, and leaves nothing behind that would
// change what is done after it.

#include "core/cancel.h"

#include <map>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "pipeline.h"
#include "support/vessel_surfaces.h"

namespace hexwall::test {
namespace {

// A sac, so that poles are looked for, and layers that meet at its neck, so that they are fitted
// and evened out.
const PrepareResult& prepared_sac() {
  static const PrepareResult prepared = prepare_surface({tube_with_sac(), {}, {}, {}});
  return prepared;
}

PipelineOptions coarse() {
  PipelineOptions options;
  options.size = 0.3;
  options.inward = LayerOptions{};
  return options;
}

struct Asked {
  std::vector<std::string> stages;   ///< those that began
  std::map<std::string, int> times;  ///< how often was asked in each
};

// Runs the pipeline and cancels it when it asks for the `at`-th time in `stage`.
Asked run_until(const std::string& stage, int at) {
  Asked asked;
  const CancelScope scope([&] {
    if (asked.stages.empty()) return false;
    return ++asked.times[asked.stages.back()] == at && asked.stages.back() == stage;
  });
  run_pipeline(prepared_sac(), coarse(),
               [&](const std::string& name, int, int) { asked.stages.push_back(name); });
  return asked;
}

const std::vector<std::string> all_stages{"form", "foliation", "quads", "relax", "wall"};

TEST(Cancel, IsThrownOnlyInsideOfAScope) {
  EXPECT_NO_THROW(throw_if_cancelled());
  {
    const CancelScope outer([] { return true; });
    EXPECT_THROW(throw_if_cancelled(), Cancelled);
    {
      const CancelScope inner([] { return false; });
      EXPECT_NO_THROW(throw_if_cancelled());
      std::thread([] { EXPECT_NO_THROW(throw_if_cancelled()); }).join();
    }
    EXPECT_THROW(throw_if_cancelled(), Cancelled);
  }
  EXPECT_NO_THROW(throw_if_cancelled());
}

TEST(Cancel, EndsTheStageThatIsRunning) {
  for (std::size_t i = 0; i < all_stages.size(); ++i) {
    std::vector<std::string> begun;
    std::stop_source stop;
    const CancelScope scope([&] { return stop.stop_requested(); });
    EXPECT_THROW(run_pipeline(prepared_sac(), coarse(),
                              [&](const std::string& stage, int, int) {
                                begun.push_back(stage);
                                if (stage == all_stages[i]) stop.request_stop();
                              }),
                 Cancelled);
    EXPECT_EQ(begun, std::vector(all_stages.begin(), all_stages.begin() + i + 1));
  }
}

TEST(Cancel, IsAskedOverAndOverInLongStages) {
  const Asked asked = run_until("", 0);
  ASSERT_EQ(asked.stages, all_stages);
  EXPECT_GT(asked.times.at("form"), 200);
  EXPECT_GT(asked.times.at("relax"), 60);
  EXPECT_GT(asked.times.at("wall"), 200);
  for (const char* stage : {"form", "relax", "wall"}) {
    for (const int share : {4, 2}) {
      EXPECT_THROW(run_until(stage, asked.times.at(stage) / share), Cancelled) << stage;
    }
  }
}

TEST(Cancel, EndsThePreparation) {
  const CancelScope scope([] { return true; });
  EXPECT_THROW(prepare_surface({tube_with_sac(), {}, {}, {}}), Cancelled);
}

TEST(Cancel, LetsExceptionsOfTheCallerOut) {
  struct Interrupt {};
  const CancelScope scope([]() -> bool { throw Interrupt(); });
  EXPECT_THROW(run_pipeline(prepared_sac(), coarse()), Interrupt);
}

TEST(Cancel, LeavesNothingBehind) {
  const std::vector<Vec3> points = run_pipeline(prepared_sac(), coarse()).wall.points;
  EXPECT_THROW(run_until("wall", 50), Cancelled);
  EXPECT_EQ(run_pipeline(prepared_sac(), coarse()).wall.points, points);
}

}  // namespace
}  // namespace hexwall::test
