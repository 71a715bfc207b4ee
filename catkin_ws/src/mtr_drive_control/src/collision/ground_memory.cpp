/// @file
/// Cells of the ground near the robot.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/collision/ground_memory.hpp"

#include <algorithm>

#include "mtr_drive_control/arithmetic.hpp"

namespace mtr_drive_control {
namespace {

constexpr double kCellM = 0.1;
// Distance from the centre of a cell to its corner.
constexpr double kHalfDiagonalM = 0.0708;
constexpr double kDrivesMps = 0.05;
// Cells per side; the grid wraps around, so it need not be shifted with the robot.
constexpr int kSide = 64;
constexpr double kReachM = 0.45 * kSide * kCellM;
// Free space is recorded along every n-th beam: 0.1 m apart at 4 m for 720 beams.
constexpr std::size_t kBeamStep = 4;
// Margin before an echo, so that its noise, or a cell cut by a surface, does not count as free space.
constexpr double kBeforeEchoM = 0.1;
// A thing that was not seen for this time, although its place was, has gone.
constexpr std::int64_t kGoneNs = 300'000'000;
constexpr std::int64_t kStandsAfterNs = 2'000'000'000;
constexpr std::int64_t kMovesBeforeNs = 1'000'000'000;
// Longer than two sweeps: out of view.
constexpr std::int64_t kLostAfterNs = 150'000'000;

// Margin around the outline of a robot at rest.
constexpr double kAroundRestM = 0.01;
constexpr double kElsewhereM = 0.3;
constexpr std::size_t kRests = 8;
constexpr double kRestsMps = 0.02;
constexpr double kRestsRadps = 0.02;

int cell_of(double coordinate_m) { return floored(coordinate_m / kCellM); }
double centre_of(int cell) { return (cell + 0.5) * kCellM; }
Point centre_of(const Point& point) { return {centre_of(cell_of(point.x_m)), centre_of(cell_of(point.y_m))}; }
std::size_t index_of(int column, int row) {
  return static_cast<std::size_t>(row & (kSide - 1)) * kSide + static_cast<std::size_t>(column & (kSide - 1));
}

}  // namespace

GroundMemory::GroundMemory() : cells_(static_cast<std::size_t>(kSide * kSide)) {}

void GroundMemory::stand(const Footprint& footprint, const Motion& motion) {
  keep_rest(footprint, motion);
  // A cell that it covers only partly may contain a foot. The LiDAR saw the ground next to its track before.
  const double beside_m = std::abs(motion.velocity.linear_mps) > kDrivesMps ? kCellM : -kHalfDiagonalM;
  const Footprint covered{footprint.front_m - kHalfDiagonalM, footprint.rear_m - kHalfDiagonalM,
                          footprint.half_width_m + beside_m};
  for (double x = -covered.rear_m; x <= covered.front_m; x += kCellM / 2.0) {
    for (double y = -covered.half_width_m; y <= covered.half_width_m; y += kCellM / 2.0) {
      const Point centre = centre_of(motion.odom_from_base.apply({x, y}));
      if (covered.distance_to(motion.odom_from_base.undo(centre)) == 0.0) {
        see_free(centre, motion.stamp_ns);
      }
    }
  }
}

void GroundMemory::keep_rest(const Footprint& footprint, const Motion& motion) {
  const Pose& here = motion.odom_from_base;
  const auto near = std::find_if(rests_.begin(), rests_.end(), [&](const Rest& rest) {
    return distance_m(rest.odom_from_base.position(), here.position()) < kElsewhereM;
  });
  const bool rests =
      std::abs(motion.velocity.linear_mps) < kRestsMps && std::abs(motion.velocity.angular_radps) < kRestsRadps;
  if (near != rests_.end()) {
    near->last_ns = motion.stamp_ns;
  } else if (rests) {
    const Footprint outline{footprint.front_m + kAroundRestM, footprint.rear_m + kAroundRestM,
                            footprint.half_width_m + kAroundRestM};
    rests_.push_back({outline, here, motion.stamp_ns});
    rests_.erase(rests_.begin(), rests_.begin() + (rests_.size() > kRests ? 1 : 0));
  }
}

std::int64_t GroundMemory::rested_ns(const Point& point) const {
  std::int64_t newest_ns = 0;
  for (const Rest& rest : rests_) {
    if (rest.outline.distance_to(rest.odom_from_base.undo(point)) == 0.0) {
      newest_ns = std::max(newest_ns, rest.last_ns);
    }
  }
  return newest_ns;
}

void GroundMemory::observe(const Sweep& sweep, const BeamDirections& directions, const View& view) {
  for (std::size_t beam = 0; beam < sweep.ranges_m.size(); beam += kBeamStep) {
    const double free_m = sweep.is_far(beam)    ? kReachM
                          : sweep.is_echo(beam) ? std::min<double>(sweep.ranges_m[beam] - kBeforeEchoM, kReachM)
                                                : 0.0;
    const std::int64_t stamp_ns = sweep.time_ns(static_cast<double>(beam));
    const Pose& odom_from_base = view.pose_at(beam);
    const Point start = odom_from_base.apply(directions.in_base(0.0, beam));
    const Point next = odom_from_base.apply(directions.in_base(1.0, beam));
    const Point way{next.x_m - start.x_m, next.y_m - start.y_m};
    for (double range = 0.0; range < free_m; range += kCellM) {
      see_free({start.x_m + range * way.x_m, start.y_m + range * way.y_m}, stamp_ns);
    }
  }
}

void GroundMemory::remember(const std::vector<Echo>& echoes, const Motion& motion) {
  for (const Echo& echo : echoes) {
    if (!is_within(echo.point, motion.odom_from_base.position(), kReachM)) {
      continue;
    }
    Cell& cell = cell_at(echo.point);
    if (echo.stamp_ns - cell.hit_ns > kGoneNs) {
      cell.since_ns = echo.stamp_ns;
    }
    cell.hit_ns = std::max(cell.hit_ns, echo.stamp_ns);
    cell.is_wide = cell.is_wide || echo.is_wide;
  }
}

bool GroundMemory::was_wide(const Point& point) const {
  for (int column = cell_of(point.x_m) - 1; column <= cell_of(point.x_m) + 1; ++column) {
    for (int row = cell_of(point.y_m) - 1; row <= cell_of(point.y_m) + 1; ++row) {
      const Cell* cell = find(column, row);
      if (cell != nullptr && cell->is_wide) {
        return true;
      }
    }
  }
  return false;
}

bool GroundMemory::has_stood(const Point& point) const {
  const Cell* cell = find(cell_of(point.x_m), cell_of(point.y_m));
  return cell != nullptr && cell->hit_ns - cell->since_ns > kStandsAfterNs;
}

bool GroundMemory::was_free(const Point& point, std::int64_t now_ns, double max_age_s) const {
  const Cell* cell = find(cell_of(point.x_m), cell_of(point.y_m));
  const std::int64_t free_ns = std::max(cell != nullptr ? cell->free_ns : 0, rested_ns(point));
  const std::int64_t hit_ns = cell != nullptr ? cell->hit_ns : 0;
  return free_ns > hit_ns && static_cast<double>(now_ns - free_ns) * 1e-9 <= max_age_s;
}

std::vector<LostThing> GroundMemory::lost_things(std::int64_t now_ns, double max_age_s) const {
  std::vector<LostThing> lost;
  for (const Cell& cell : cells_) {
    const std::int64_t age_ns = now_ns - cell.hit_ns;
    if (cell.hit_ns > cell.free_ns && age_ns > kLostAfterNs && static_cast<double>(age_ns) * 1e-9 <= max_age_s) {
      lost.push_back({{centre_of(cell.column), centre_of(cell.row)},
                      cell.hit_ns,
                      !cell.is_wide && cell.hit_ns - cell.since_ns < kMovesBeforeNs});
    }
  }
  return lost;
}

GroundMemory::Cell& GroundMemory::cell_at(const Point& point) {
  const int column = cell_of(point.x_m);
  const int row = cell_of(point.y_m);
  Cell& cell = cells_[index_of(column, row)];
  if (cell.column != column || cell.row != row) {
    cell = Cell{};
    cell.column = column;
    cell.row = row;
  }
  return cell;
}

const GroundMemory::Cell* GroundMemory::find(int column, int row) const {
  const Cell& cell = cells_[index_of(column, row)];
  return cell.column == column && cell.row == row ? &cell : nullptr;
}

void GroundMemory::see_free(const Point& point, std::int64_t stamp_ns) {
  Cell& cell = cell_at(point);
  cell.free_ns = std::max(cell.free_ns, stamp_ns);
  if (cell.free_ns - cell.hit_ns > kGoneNs) {
    cell.is_wide = false;
  }
}

}  // namespace mtr_drive_control
