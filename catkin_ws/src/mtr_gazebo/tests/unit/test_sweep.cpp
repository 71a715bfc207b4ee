/// @file
/// Turn of a LiDAR: each beam once, at its own time, for any physics step.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/sweep.hpp"

using mtr_gazebo::Beam;
using mtr_gazebo::Sweep;
using mtr_gazebo::SweepFigures;

namespace {

constexpr SweepFigures kFigures{721, 1.5 * M_PI, 40'100'000, 0.1, 30.0};
constexpr std::int64_t kStartNs = 1'026'000'000;
constexpr std::int64_t kStepNs = 1'000'000;

struct Seen {
  std::vector<Beam> beams;
  std::vector<std::int64_t> turns;
};

Seen seen_until(std::int64_t end_ns, std::int64_t step_ns) {
  Sweep sweep(kFigures, kStartNs);
  Seen seen;
  for (std::int64_t now_ns = 1'000'000'000; now_ns <= end_ns; now_ns += step_ns) {
    sweep.advance(
        now_ns,
        [&](const Beam& beam) {
          EXPECT_LE(beam.time_ns, now_ns);
          EXPECT_GT(beam.time_ns, now_ns - step_ns);
          seen.beams.push_back(beam);
        },
        [&](std::int64_t start_ns) { seen.turns.push_back(start_ns); });
  }
  return seen;
}

TEST(Sweep, CastsEachBeamOnceAtItsOwnInstant) {
  const Seen seen = seen_until(kStartNs + 41 * kStepNs, kStepNs);
  ASSERT_EQ(seen.turns, (std::vector<std::int64_t>{kStartNs}));
  ASSERT_GE(seen.beams.size(), 721U);
  for (int index = 0; index < 721; ++index) {
    const Beam& beam = seen.beams[static_cast<std::size_t>(index)];
    EXPECT_EQ(beam.index, index);
    EXPECT_NEAR(beam.angle_rad, -0.75 * M_PI + index * 1.5 * M_PI / 720.0, 1e-9);
    // Three quarters of a turn of 40.1 ms are within the field of view.
    EXPECT_NEAR(static_cast<double>(beam.time_ns - kStartNs), index / 720.0 * 0.75 * 40.1e6, 1.0);
  }
}

TEST(Sweep, TurnsOnAtItsOwnPeriod) {
  const Seen seen = seen_until(kStartNs + 3 * 40'100'000 + kStepNs, kStepNs);
  EXPECT_EQ(seen.turns, (std::vector<std::int64_t>{kStartNs, kStartNs + 40'100'000, kStartNs + 80'200'000}));
}

TEST(Sweep, CatchesUpWithAStepLongerThanATurn) {
  const Seen seen = seen_until(kStartNs + 500 * kStepNs, 100 * kStepNs);
  // 474 ms: eleven turns, and the whole visible part of the twelfth.
  EXPECT_EQ(seen.turns.size(), 11U);
  EXPECT_EQ(seen.beams.size(), 12U * 721U);
}

TEST(RangeReading, SaysWhatIsOutOfRange) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_FLOAT_EQ(mtr_gazebo::range_reading(2.0, 0.01, kFigures), 2.01F);
  EXPECT_EQ(mtr_gazebo::range_reading(kInfinity, -0.01, kFigures), std::numeric_limits<float>::infinity());
  EXPECT_EQ(mtr_gazebo::range_reading(30.005, 0.0, kFigures), std::numeric_limits<float>::infinity());
  EXPECT_EQ(mtr_gazebo::range_reading(0.1, -0.01, kFigures), -std::numeric_limits<float>::infinity());
}

}  // namespace
