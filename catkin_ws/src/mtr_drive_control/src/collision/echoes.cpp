/// @file
/// Clusters of echoes: their size distinguishes rain, things and surfaces.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/collision/echoes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mtr_drive_control/arithmetic.hpp"

namespace mtr_drive_control {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kNothing = std::numeric_limits<double>::infinity();
// Two echoes belong together if they are closer than this plus a share of their range. The share covers the wider
// spacing of beams and echoes at larger ranges.
constexpr double kGapM = 0.08;
constexpr double kGapPerRange = 0.03;
// Maximum number of beams between two echoes of one cluster that ended elsewhere, e.g. on a raindrop.
constexpr std::size_t kMostBeamsBetween = 3;
// Number of beams on a leg of 0.14 m at 5 m (720 beams over 270 degrees).
constexpr int kBeamsThatCountAtOnce = 4;
// Smaller clusters count if they are seen in this number of sweeps within this distance of their place.
constexpr int kSweepsThatCount = 4;
constexpr double kSamePlaceM = 0.05;
// Two legs in full stride are narrower; a wheel seen from its side is wider.
constexpr double kWiderThanAPersonM = 0.5;
// With a narrower view to either side, a LiDAR would leave ground next to the robot unwatched.
constexpr double kLeastViewRad = 2.0;
// Step of the search for objects below the measuring range.
constexpr double kNearStepM = 0.01;

struct Cluster {
  int beams = 0;
  std::size_t first = std::numeric_limits<std::size_t>::max(), last = 0;
  double min_x = 1e9, max_x = -1e9, min_y = 1e9, max_y = -1e9;

  void add(std::size_t beam, const Point& point) {
    ++beams;
    first = std::min(first, beam);
    last = std::max(last, beam);
    min_x = std::min(min_x, point.x_m);
    max_x = std::max(max_x, point.x_m);
    min_y = std::min(min_y, point.y_m);
    max_y = std::max(max_y, point.y_m);
  }
  bool is_wide() const { return std::hypot(max_x - min_x, max_y - min_y) > kWiderThanAPersonM; }
};

}  // namespace

EchoFinder::EchoFinder(const LidarMount& mount, const Footprint& footprint, double own_view_rad)
    : mount_(mount),
      footprint_(footprint),
      own_view_rad_(own_view_rad),
      directions_(mount),
      lowest_rad_(-kLeastViewRad),
      highest_rad_(kLeastViewRad) {}

void EchoFinder::read(const Sweep& sweep) {
  directions_.follow(sweep);
  ranges_m_.resize(sweep.ranges_m.size());
  for (std::size_t beam = 0; beam < ranges_m_.size(); ++beam) {
    ranges_m_[beam] = range_of(sweep, beam);
  }
}

std::vector<Echo> EchoFinder::find(const Sweep& sweep, const View& view, double max_range_m) {
  const std::vector<Hit> found = hits(max_range_m);
  std::vector<Cluster> clusters;
  for (const Hit& hit : found) {
    clusters.resize(std::max(clusters.size(), static_cast<std::size_t>(hit.cluster) + 1));
    clusters[static_cast<std::size_t>(hit.cluster)].add(hit.beam, hit.in_base);
  }
  std::vector<Echo> echoes;
  echoes.reserve(found.size());
  std::vector<Small> small;
  for (const Hit& hit : found) {
    const Point point = view.pose_at(hit.beam).apply(hit.in_base);
    const Cluster& cluster = clusters[static_cast<std::size_t>(hit.cluster)];
    if (cluster.beams < kBeamsThatCountAtOnce) {
      small.push_back({point, sweeps_seen(point) + 1});
      if (small.back().sweeps_seen < kSweepsThatCount) {
        continue;
      }
    }
    const double span_rad = static_cast<double>(cluster.last - cluster.first) * std::abs(sweep.angle_increment_rad);
    const std::int64_t stamp_ns = sweep.time_ns(static_cast<double>(hit.beam));
    echoes.push_back({point, stamp_ns, cluster.is_wide(), hit.range_m, hit.beam, span_rad});
  }
  small_ = std::move(small);
  return echoes;
}

View EchoFinder::view_of(const Sweep& sweep, const Motion& motion) const {
  std::vector<double> returned_m(sweep.ranges_m.size());
  for (std::size_t beam = 0; beam < returned_m.size(); ++beam) {
    const double without_echo = sweep.is_echo(beam) ? 0.0 : kNothing;
    returned_m[beam] = ranges_m_[beam].value_or(without_echo);
  }
  return {sweep, mount_, motion, std::move(returned_m)};
}

std::optional<Sector> EchoFinder::covered_sector(const Sweep& sweep) {
  const double first_rad = sweep.angle_of(0);
  const double last_rad = sweep.angle_of(sweep.ranges_m.size() - 1);
  const auto [low_rad, high_rad] = std::minmax(first_rad, last_rad);
  lowest_rad_ = std::min(lowest_rad_, low_rad);
  highest_rad_ = std::max(highest_rad_, high_rad);
  Sector widest{std::max(lowest_rad_, -own_view_rad_), low_rad};
  const auto keep_wider = [&widest](double from_rad, double to_rad) {
    widest = to_rad - from_rad > widest.to_rad - widest.from_rad ? Sector{from_rad, to_rad} : widest;
  };
  keep_wider(high_rad, std::min(highest_rad_, own_view_rad_));
  const double step_rad = std::abs(sweep.angle_increment_rad);
  double unseen_rad = 0.0;
  for (std::size_t beam = 0; beam < sweep.ranges_m.size(); ++beam) {
    const double angle_rad = sweep.angle_of(beam);
    const bool is_own = std::abs(wrapped_rad(angle_rad)) <= own_view_rad_;
    const bool is_unseen = is_own && !sweep.is_far(beam) && !ranges_m_[beam];
    unseen_rad = is_unseen ? unseen_rad + step_rad : 0.0;
    const double begun_rad = sweep.angle_increment_rad > 0.0 ? angle_rad - unseen_rad : angle_rad;
    keep_wider(begun_rad, begun_rad + unseen_rad);
  }
  return widest.to_rad - widest.from_rad > kLegRad ? std::optional<Sector>(in_base(widest.from_rad, widest.to_rad))
                                                   : std::nullopt;
}

bool EchoFinder::sees(const Point& point) const {
  const double angle_rad =
      std::remainder(std::atan2(point.y_m - mount_.y_m, point.x_m - mount_.x_m) - mount_.yaw_rad, 2.0 * kPi);
  return angle_rad >= lowest_rad_ && angle_rad <= highest_rad_;
}

Sector EchoFinder::in_base(double low_rad, double high_rad) const {
  return {std::remainder(mount_.yaw_rad + low_rad, 2.0 * kPi), std::remainder(mount_.yaw_rad + high_rad, 2.0 * kPi)};
}

std::optional<double> EchoFinder::range_of(const Sweep& sweep, std::size_t beam) const {
  if (sweep.is_echo(beam)) {
    const double range_m = sweep.ranges_m[beam];
    // Echo of the robot's own mast or lift.
    const bool is_own = footprint_.contains(directions_.in_base(range_m, beam));
    return is_own ? std::nullopt : std::optional<double>(range_m);
  }
  for (double range_m = kNearStepM; sweep.is_near(beam) && range_m < sweep.range_min_m; range_m += kNearStepM) {
    if (!footprint_.contains(directions_.in_base(range_m, beam))) {
      return range_m;
    }
  }
  return std::nullopt;
}

std::vector<EchoFinder::Hit> EchoFinder::hits(double max_range_m) const {
  std::vector<Hit> hits;
  hits.reserve(ranges_m_.size());
  int clusters = 0;
  for (std::size_t beam = 0; beam < ranges_m_.size(); ++beam) {
    const double range = ranges_m_[beam].value_or(max_range_m);
    if (range >= max_range_m) {
      continue;
    }
    const Point point = directions_.in_base(range, beam);
    int cluster = -1;
    for (auto before = hits.rbegin(); before != hits.rend() && beam - before->beam <= kMostBeamsBetween; ++before) {
      if (is_nearer(before->in_base, point, kGapM + kGapPerRange * range)) {
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
    if (before.sweeps_seen > most && is_nearer(before.point, point, kSamePlaceM)) {
      most = before.sweeps_seen;
    }
  }
  return most;
}

}  // namespace mtr_drive_control
