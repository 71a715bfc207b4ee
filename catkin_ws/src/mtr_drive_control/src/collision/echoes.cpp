/// @file
/// Clusters of echoes: their size tells rain from things and things from surfaces.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/collision/echoes.hpp"

#include <algorithm>
#include <cmath>

namespace mtr_drive_control {
namespace {

constexpr double kPi = 3.14159265358979323846;
// Two echoes belong together when they are nearer than this plus a share of their range, which covers the wider
// spacing of beams and echoes farther away.
constexpr double kGapM = 0.08;
constexpr double kGapPerRange = 0.03;
// So many beams between two echoes of one cluster may have ended elsewhere, e.g. on a raindrop.
constexpr std::size_t kMostBeamsBetween = 3;
// A leg of 0.14 m has so many beams at 5 m (720 beams over 270 degrees).
constexpr int kBeamsThatCountAtOnce = 4;
// Smaller clusters count when seen in so many sweeps within so much of their place.
constexpr int kSweepsThatCount = 4;
constexpr double kSamePlaceM = 0.05;
// Two legs in full stride measure less across; a wheel seen from its side more.
constexpr double kWiderThanAPersonM = 0.5;
// In 1 m a leg is as wide; two legs are farther apart.
constexpr double kWidestUnseenRad = 0.175;
// What is too near to be measured is looked for in such steps.
constexpr double kNearStepM = 0.01;

struct Cluster {
  int beams = 0;
  double min_x = 1e9, max_x = -1e9, min_y = 1e9, max_y = -1e9;

  void add(const Point& point) {
    ++beams;
    min_x = std::min(min_x, point.x_m);
    max_x = std::max(max_x, point.x_m);
    min_y = std::min(min_y, point.y_m);
    max_y = std::max(max_y, point.y_m);
  }
  bool is_wide() const { return std::hypot(max_x - min_x, max_y - min_y) > kWiderThanAPersonM; }
};

}  // namespace

std::vector<Echo> EchoFinder::find(const Sweep& sweep, const Motion& motion, double max_range_m) {
  const std::vector<Hit> hits = hits_of(sweep, max_range_m);
  std::vector<Cluster> clusters;
  for (const Hit& hit : hits) {
    clusters.resize(std::max(clusters.size(), static_cast<std::size_t>(hit.cluster) + 1));
    clusters[static_cast<std::size_t>(hit.cluster)].add(hit.in_base);
  }
  std::vector<Echo> echoes;
  std::vector<Small> small;
  for (const Hit& hit : hits) {
    const auto stamp_ns = sweep.stamp_ns + static_cast<std::int64_t>(1e9 * sweep.time_increment_s * hit.beam);
    const Point point = motion.at(stamp_ns).apply(hit.in_base);
    const Cluster& cluster = clusters[static_cast<std::size_t>(hit.cluster)];
    if (cluster.beams < kBeamsThatCountAtOnce) {
      small.push_back({point, sweeps_seen(point) + 1});
      if (small.back().sweeps_seen < kSweepsThatCount) {
        continue;
      }
    }
    echoes.push_back({point, stamp_ns, cluster.is_wide()});
  }
  small_ = std::move(small);
  return echoes;
}

bool EchoFinder::is_covered(const Sweep& sweep) const {
  double unseen_rad = 0.0;
  for (std::size_t beam = 0; beam < sweep.ranges_m.size(); ++beam) {
    const bool is_own = std::abs(std::remainder(sweep.angle_of(beam), 2.0 * kPi)) <= own_view_rad_;
    const bool is_unseen = is_own && !sweep.is_far(beam) && !range_of(sweep, beam);
    unseen_rad = is_unseen ? unseen_rad + std::abs(sweep.angle_increment_rad) : 0.0;
    if (unseen_rad > kWidestUnseenRad) {
      return true;
    }
  }
  return false;
}

std::optional<double> EchoFinder::range_of(const Sweep& sweep, std::size_t beam) const {
  const double angle_rad = sweep.angle_of(beam);
  if (sweep.is_echo(beam)) {
    const double range_m = sweep.ranges_m[beam];
    // The robot's own mast and lift.
    const bool is_own = footprint_.distance_to(mount_.in_base(range_m, angle_rad)) == 0.0;
    return is_own ? std::nullopt : std::optional<double>(range_m);
  }
  for (double range_m = kNearStepM; sweep.is_near(beam) && range_m < sweep.range_min_m; range_m += kNearStepM) {
    if (footprint_.distance_to(mount_.in_base(range_m, angle_rad)) > 0.0) {
      return range_m;
    }
  }
  return std::nullopt;
}

std::vector<EchoFinder::Hit> EchoFinder::hits_of(const Sweep& sweep, double max_range_m) const {
  std::vector<Hit> hits;
  int clusters = 0;
  for (std::size_t beam = 0; beam < sweep.ranges_m.size(); ++beam) {
    const double range = range_of(sweep, beam).value_or(max_range_m);
    if (range >= max_range_m) {
      continue;
    }
    const Point point = mount_.in_base(range, sweep.angle_of(beam));
    int cluster = -1;
    for (auto before = hits.rbegin(); before != hits.rend() && beam - before->beam <= kMostBeamsBetween; ++before) {
      if (distance_m(before->in_base, point) < kGapM + kGapPerRange * range) {
        cluster = before->cluster;
        break;
      }
    }
    hits.push_back({beam, point, range, cluster < 0 ? clusters++ : cluster});
  }
  return hits;
}

int EchoFinder::sweeps_seen(const Point& point) const {
  int most = 0;
  for (const Small& before : small_) {
    if (distance_m(before.point, point) < kSamePlaceM) {
      most = std::max(most, before.sweeps_seen);
    }
  }
  return most;
}

}  // namespace mtr_drive_control
