// SPDX-License-Identifier: Apache-2.0
#include "core/sweep.hpp"

#include <cmath>
#include <limits>

namespace mtr_gazebo {
namespace {

constexpr double kTurnRad = 2.0 * M_PI;
constexpr double kNsPerS = 1e9;

}  // namespace

Sweep::Sweep(const SweepFigures& figures, std::int64_t start_ns) : figures_(figures), start_ns_(start_ns) {}

void Sweep::advance(std::int64_t now_ns, const Cast& cast, const Finish& finish) {
  while (true) {
    while (next_ < figures_.beams && beam().time_ns <= now_ns) {
      cast(beam());
      ++next_;
    }
    if (now_ns < start_ns_ + figures_.rotation_ns) {
      return;
    }
    finish(start_ns_);
    start_ns_ += figures_.rotation_ns;
    next_ = 0;
  }
}

double Sweep::angle_increment_rad() const { return figures_.field_of_view_rad / (figures_.beams - 1); }

double Sweep::time_increment_s() const {
  return angle_increment_rad() / kTurnRad * static_cast<double>(figures_.rotation_ns) / kNsPerS;
}

Beam Sweep::beam() const {
  return {next_, next_ * angle_increment_rad() - 0.5 * figures_.field_of_view_rad,
          start_ns_ + std::llround(next_ * time_increment_s() * kNsPerS)};
}

float range_reading(double distance_m, double error_m, const SweepFigures& figures) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const double range_m = distance_m + error_m;
  if (range_m > figures.range_max_m) {
    return kInfinity;
  }
  return range_m < figures.range_min_m ? -kInfinity : static_cast<float>(range_m);
}

}  // namespace mtr_gazebo
