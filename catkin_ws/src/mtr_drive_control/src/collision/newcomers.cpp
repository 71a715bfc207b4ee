/// @file
/// Cells of the surroundings: free, established or newly occupied.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/collision/newcomers.hpp"

#include <algorithm>
#include <cmath>

#include "mtr_drive_control/arithmetic.hpp"

namespace mtr_drive_control {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kCellM = 0.2;
// 0.15 m apart at the end of the range for 720 beams over 270 degrees.
constexpr std::size_t kBeamStep = 4;
// Noise of a range, and the part of a cell that a surface cuts.
constexpr double kBeforeEchoM = 0.2;
// Ground counts as free after being seen free for this time: a pitch of the robot is shorter.
constexpr std::int64_t kFreeForNs = 400'000'000;
// After a longer time the steady frame has drifted.
constexpr std::int64_t kFreeWithinNs = 10'000'000'000;
// A surface has gone if its place was seen free for this time. A pitch shows ground behind an established one.
constexpr std::int64_t kNewcomerGoneNs = 300'000'000;
constexpr std::int64_t kEstablishedGoneNs = 1'000'000'000;
// Within this time an established surface may drift by a cell; a slower mover counts as established.
constexpr std::int64_t kEstablishedAfterNs = 2'000'000'000;
// Consecutive sweeps, so that neither rain nor ground seen during a pitch is a newcomer.
constexpr int kSweepsInARow = 3;
constexpr std::int64_t kNextSweepNs = 100'000'000;
// Error of a valid position, as in map_witness.cpp.
constexpr double kMapToleranceM = 0.4;

// The odometry restarted after a longer silence or a larger step.
constexpr double kGapS = 0.2;
constexpr double kStepM = 0.5;
// Without a gyro a turn is uncertain by some ten percent.
constexpr double kTurnsRadps = 0.05;
// The gyro's bias is tracked while the wheels are at rest.
constexpr double kRestsMps = 0.005;
constexpr double kRestsRadps = 0.005;
constexpr double kBiasShare = 0.02;

int cell_of(double coordinate_m) { return floored(coordinate_m / kCellM); }

}  // namespace

bool SteadyFrame::follow(const Motion& motion, const std::optional<double>& gyro_radps) {
  if (stamp_ns_ == motion.stamp_ns) {
    return true;
  }
  const double since_s = stamp_ns_ ? static_cast<double>(motion.stamp_ns - *stamp_ns_) * 1e-9 : 0.0;
  const Point moved = odom_from_base_.undo(motion.odom_from_base.position());
  const double by_wheels_rad =
      std::remainder(motion.odom_from_base.heading_rad() - odom_from_base_.heading_rad(), 2.0 * kPi);
  const Velocity& velocity = motion.velocity;
  if (gyro_radps && std::abs(velocity.linear_mps) < kRestsMps && std::abs(velocity.angular_radps) < kRestsRadps) {
    bias_radps_ += kBiasShare * (*gyro_radps - bias_radps_);
  }
  const double rate_radps = gyro_radps ? *gyro_radps - bias_radps_ : velocity.angular_radps;
  const bool continues = stamp_ns_ && since_s > 0.0 && since_s <= kGapS && std::hypot(moved.x_m, moved.y_m) < kStepM &&
                         (gyro_radps || std::abs(velocity.angular_radps) < kTurnsRadps);
  const double turned_rad = gyro_radps ? rate_radps * since_s : by_wheels_rad;
  // The chord points along the mean heading of the step.
  const Pose chord(pose_.position().x_m, pose_.position().y_m,
                   pose_.heading_rad() + 0.5 * (turned_rad - by_wheels_rad));
  const Point here = chord.apply(moved);
  pose_ = continues ? Pose(here.x_m, here.y_m, pose_.heading_rad() + turned_rad) : Pose();
  odom_from_base_ = motion.odom_from_base;
  stamp_ns_ = motion.stamp_ns;
  motion_ = {motion.stamp_ns, pose_, {velocity.linear_mps, rate_radps}};
  return continues;
}

void Newcomers::observe(const Sweep& sweep, const BeamDirections& directions, const Motion& motion) {
  const auto free_to_m = [&](std::size_t beam) {
    return sweep.is_far(beam)    ? kNewcomerReachM
           : sweep.is_echo(beam) ? std::min<double>(sweep.ranges_m[beam], kNewcomerReachM) - kBeforeEchoM
                                 : 0.0;
  };
  for (std::size_t beam = kBeamStep; beam + kBeamStep < sweep.ranges_m.size(); beam += kBeamStep) {
    // On a surface at a flat angle, the neighbouring beam shows its near end.
    const double free_m = std::min({free_to_m(beam - kBeamStep), free_to_m(beam), free_to_m(beam + kBeamStep)});
    const std::int64_t stamp_ns = sweep.time_ns(static_cast<double>(beam));
    const Pose steady_from_base = motion.at(stamp_ns);
    const Point start = steady_from_base.apply(directions.in_base(0.0, beam));
    const Point next = steady_from_base.apply(directions.in_base(1.0, beam));
    const Point way{next.x_m - start.x_m, next.y_m - start.y_m};
    for (double range = 0.0; range < free_m; range += kCellM) {
      see_free({start.x_m + range * way.x_m, start.y_m + range * way.y_m}, stamp_ns);
    }
  }
}

void Newcomers::see_free(const Point& place, std::int64_t stamp_ns) {
  Cell& cell = cell_at(cell_of(place.x_m), cell_of(place.y_m));
  cell.free_since_ns = cell.free_since_ns == 0 ? stamp_ns : cell.free_since_ns;
  cell.free_ns = std::max(cell.free_ns, stamp_ns);
  const std::int64_t gone_ns = cell.state == State::kEstablished ? kEstablishedGoneNs : kNewcomerGoneNs;
  if (cell.state != State::kNone && cell.free_ns - cell.free_since_ns > gone_ns) {
    cell.state = State::kNone;
    cell.is_unmapped = false;
    cell.asked = nullptr;
  }
}

void Newcomers::remember(const Point& place, std::int64_t sweep_ns, const SiteMap* map,
                         const std::optional<Point>& in_map) {
  Cell& cell = cell_at(cell_of(place.x_m), cell_of(place.y_m));
  if (cell.sweep_ns == sweep_ns && cell.state != State::kNone) {
    return;
  }
  cell.run = run_at(cell, sweep_ns);
  if (cell.state == State::kNone) {
    cell.since_ns = sweep_ns;
    cell.asked = nullptr;
    cell.is_unmapped = false;
  }
  if (map != nullptr && in_map && map != cell.asked) {
    cell.asked = map;
    cell.is_unmapped = map->is_free_around(*in_map, kMapToleranceM);
  }
  cell.state = state_of_hit(cell, sweep_ns);
  cell.sweep_ns = sweep_ns;
  cell.free_since_ns = 0;
}

int Newcomers::run_at(const Cell& cell, std::int64_t sweep_ns) const {
  int run = 1;
  for (int column = cell.column - 1; column <= cell.column + 1; ++column) {
    for (int row = cell.row - 1; row <= cell.row + 1; ++row) {
      const Cell* near = find(column, row);
      if (near != nullptr && near->run > 0 && sweep_ns - near->sweep_ns <= kNextSweepNs) {
        run = std::max(run, near->run + (near->sweep_ns < sweep_ns ? 1 : 0));
      }
    }
  }
  return std::min(run, kSweepsInARow);
}

Newcomers::State Newcomers::state_of_hit(const Cell& cell, std::int64_t sweep_ns) const {
  if (cell.state == State::kEstablished || cell.state == State::kNewcomer) {
    return cell.state;
  }
  if (cell.state == State::kNone && !was_free(cell, sweep_ns)) {
    return State::kEstablished;
  }
  const bool has_run = cell.run >= kSweepsInARow;
  if (has_run && has_neighbour(cell, State::kNewcomer, sweep_ns - kNextSweepNs)) {
    return State::kNewcomer;
  }
  if (has_neighbour(cell, State::kEstablished, 0)) {
    return sweep_ns - cell.since_ns > kEstablishedAfterNs ? State::kEstablished : State::kArrived;
  }
  return has_run ? State::kNewcomer : State::kArrived;
}

bool Newcomers::was_free(const Cell& cell, std::int64_t sweep_ns) const {
  for (int column = cell.column - 1; column <= cell.column + 1; ++column) {
    for (int row = cell.row - 1; row <= cell.row + 1; ++row) {
      // A surface that comes into view at a flat angle has unknown ground behind it.
      const Cell* near = find(column, row);
      const bool is_known = near != nullptr && (near->state != State::kNone || is_known_free(*near, sweep_ns));
      if (!is_known || (near == &cell && !is_known_free(cell, sweep_ns))) {
        return false;
      }
    }
  }
  return true;
}

bool Newcomers::is_known_free(const Cell& cell, std::int64_t sweep_ns) {
  return cell.free_since_ns != 0 && cell.free_ns - cell.free_since_ns >= kFreeForNs &&
         sweep_ns - cell.free_ns <= kFreeWithinNs;
}

bool Newcomers::has_neighbour(const Cell& cell, State state, std::int64_t since_ns) const {
  for (int column = cell.column - 1; column <= cell.column + 1; ++column) {
    for (int row = cell.row - 1; row <= cell.row + 1; ++row) {
      const Cell* near = find(column, row);
      if (near != nullptr && near->state == state && near->sweep_ns >= since_ns) {
        return true;
      }
    }
  }
  return false;
}

bool Newcomers::has_come(const Point& place) const {
  const Cell* cell = find(place);
  return cell != nullptr && cell->state == State::kNewcomer;
}

bool Newcomers::may_be_person(const Point& place) const {
  const Cell* cell = find(place);
  return cell != nullptr && (cell->state == State::kNewcomer || (cell->is_unmapped && cell->run >= kSweepsInARow));
}

Newcomers::Cell& Newcomers::cell_at(int column, int row) {
  Cell& cell =
      cells_[static_cast<std::size_t>(row & (kSide - 1)) * kSide + static_cast<std::size_t>(column & (kSide - 1))];
  if (cell.column != column || cell.row != row) {
    cell = Cell{};
    cell.column = column;
    cell.row = row;
  }
  return cell;
}

const Newcomers::Cell* Newcomers::find(int column, int row) const {
  const Cell& cell =
      cells_[static_cast<std::size_t>(row & (kSide - 1)) * kSide + static_cast<std::size_t>(column & (kSide - 1))];
  return cell.column == column && cell.row == row ? &cell : nullptr;
}

const Newcomers::Cell* Newcomers::find(const Point& place) const {
  return find(cell_of(place.x_m), cell_of(place.y_m));
}

}  // namespace mtr_drive_control
