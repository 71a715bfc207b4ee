/// @file
/// Comparison of expected ranges, rendered surfel by surfel from the map, with a sweep.
// SPDX-License-Identifier: Apache-2.0
#include "tracking/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "map_names.hpp"
#include "scans/ground.hpp"

namespace mtr_localization {
namespace {

constexpr int kBins = 720;
constexpr double kBinsPerRad = kBins / (2.0 * M_PI);
// One of three beams is sufficient.
constexpr double kBeamStepRad = 0.015;
constexpr double kNothing = std::numeric_limits<double>::infinity();
// Surfaces met at less than 6 degrees are not expected to be visible.
constexpr double kGrazing = 0.1;
// Tolerance per metre of range, for the heading error and the width of a bin on oblique surfaces.
constexpr double kTolerancePerM = 0.02;
// Returns at this height above or below the LiDAR may be missing on the map: sills and bumpers have about this height.
constexpr double kSameHeightM = 0.1;
// Uncertainty of the heights at which surfaces were met: bumps of the ground, and the tilt error.
constexpr double kRiseToleranceM = 0.02;
constexpr double kTiltSigmaRad = 0.003;
// Agreement of an expected view. At a wrong place almost nothing agrees, and chance rarely gives more than half.
constexpr double kExpectedShare = 0.75;
// Number of beams and share of the expected view that pass through surfaces in a contradicted view.
constexpr int kMinContradicted = 8;
constexpr double kContradictedShare = 0.25;
// Stricter limits if returns do not count. In simulation, soon after the start of a map, the agreement at the correct
// place was 0.99 to 1 of 240 beams. Half of the returns came from objects not yet on the map.
constexpr int kMinEvidenceSoFar = 3 * Agreement::kMinEvidence;
constexpr double kExpectedShareSoFar = 0.9;
// Largest lateral offset of compared surfaces in bins: 10 degrees.
constexpr int kMaxAside = 20;

int bin_of(double angle_rad) {
  const int bin = static_cast<int>(std::floor(angle_rad * kBinsPerRad)) % kBins;
  return bin < 0 ? bin + kBins : bin;
}

/// Nearest surface in each direction from one place.
class ExpectedView {
 public:
  ExpectedView(const Eigen::Vector2d& eye, const std::vector<Surfel>& surfels, double range_max_m)
      : ranges_(kBins, kNothing), surfels_(kBins, nullptr) {
    for (const Surfel& surfel : surfels) {
      draw(surfel, surfel.position - eye, range_max_m);
    }
  }

  double nearest(int bin) const { return ranges_[index_of(bin)]; }

  /// True if no beam has met the surface at the height of this beam.
  bool is_at_new_height(int bin, double climb) const {
    return beyond_heights_m(bin, climb) > kRiseToleranceM + kTiltSigmaRad * nearest(bin);
  }

  /// Distance of this beam's height from the range of heights at which the surface was met.
  double beyond_heights_m(int bin, double climb) const {
    const Surfel& surfel = *surfels_[index_of(bin)];
    const double rise_m = climb * nearest(bin);
    return std::max({surfel.lowest_rise_m - rise_m, rise_m - surfel.highest_rise_m, 0.0});
  }

 private:
  static std::size_t index_of(int bin) { return static_cast<std::size_t>((bin % kBins + kBins) % kBins); }

  void draw(const Surfel& surfel, const Eigen::Vector2d& offset, double range_max_m) {
    const double distance = offset.norm();
    const double facing = -surfel.normal.dot(offset) / distance;
    if (facing < kGrazing || distance > range_max_m) {
      return;
    }
    const double middle = std::atan2(offset.y(), offset.x());
    const double half_width = std::atan2(0.5 * surfel.length_m * facing, distance);
    const int first = static_cast<int>(std::floor((middle - half_width) * kBinsPerRad));
    const int last = static_cast<int>(std::floor((middle + half_width) * kBinsPerRad));
    for (int bin = first; bin <= last; ++bin) {
      if (distance < nearest(bin)) {
        ranges_[index_of(bin)] = distance;
        surfels_[index_of(bin)] = &surfel;
      }
    }
  }

  std::vector<double> ranges_;
  std::vector<const Surfel*> surfels_;
};

/// One beam of a sweep.
struct Beam {
  int bin;
  Eigen::Vector2d eye;
  Eigen::Vector2d direction;
  double shown;
  /// Rise per metre, and its 1 sigma.
  double climb;
  double climb_sigma;

  /// True if the beam is at another height than the map at this range.
  bool is_off_plane_at(double range) const { return std::abs(climb) > kSameHeightM / range; }

  bool shows_ground() const { return shown < kNothing && may_be_ground(climb * shown, shown, climb_sigma); }
};

/// Expected surfaces near a beam, within the lateral tolerance.
struct Surroundings {
  bool agrees = false;
  /// True if some direction has no expected surface.
  bool has_gap = false;
};

Surroundings look_around(const ExpectedView& view, const Beam& beam, double tolerance_m) {
  const double nearest = std::min(beam.shown, view.nearest(beam.bin));
  const double aside_rad = nearest < kNothing ? (tolerance_m + kTolerancePerM * nearest) / nearest : 0.0;
  const int aside = std::clamp(static_cast<int>(std::ceil(aside_rad * kBinsPerRad)), 1, kMaxAside);
  Surroundings found;
  for (int bin = beam.bin - aside; bin <= beam.bin + aside; ++bin) {
    const double range = view.nearest(bin);
    if (range == kNothing) {
      found.has_gap = true;
    } else if (std::abs(range - beam.shown) <= tolerance_m + kTolerancePerM * range) {
      found.agrees = true;
    }
  }
  return found;
}

/// True if the return is on a mapped surface, although behind a surface that was met at another height.
bool is_on_surface(const SurfelMap& map, const Beam& beam, double tolerance_m) {
  return beam.shown < kNothing &&
         map.match(beam.eye + beam.shown * beam.direction, tolerance_m + kTolerancePerM * beam.shown, beam.direction);
}

/// True if the beam passes over or under the expected surface, or meets the ground before it. Centimetres are enough if
/// a bumper or sill ends near the scan plane.
bool is_excused(const ExpectedView& view, const Beam& beam) {
  const double expected = view.nearest(beam.bin);
  return beam.is_off_plane_at(std::min(beam.shown, expected)) || beam.shows_ground() ||
         (beam.shown > expected && view.is_at_new_height(beam.bin, beam.climb));
}

void count(const ExpectedView& view, const SurfelMap& map, const Beam& beam, double tolerance_m, Agreement& agreement) {
  const double expected = view.nearest(beam.bin);
  const Surroundings around = look_around(view, beam, tolerance_m);
  const bool agrees = around.agrees || is_on_surface(map, beam, tolerance_m);
  if (expected == kNothing) {
    const bool is_known = beam.shown == kNothing || agrees;
    agreement.unknown += is_known || beam.is_off_plane_at(beam.shown) || beam.shows_ground() ? 0 : 1;
  } else if (agrees) {
    ++agreement.seen;
  } else if (is_excused(view, beam)) {
    ++agreement.excused;
  } else if (beam.shown < expected) {
    ++agreement.hidden;
  } else if (around.has_gap) {
    ++agreement.passed;
  } else {
    ++(beam.shown == kNothing ? agreement.missing : agreement.beyond);
    agreement.unsure += view.beyond_heights_m(beam.bin, beam.climb) > 0.0 ? 1 : 0;
  }
}

}  // namespace

Agreement& Agreement::operator+=(const Agreement& other) {
  seen += other.seen;
  hidden += other.hidden;
  beyond += other.beyond;
  missing += other.missing;
  passed += other.passed;
  unknown += other.unknown;
  unsure += other.unsure;
  excused += other.excused;
  return *this;
}

double Agreement::share_of_expected() const {
  // If none of the expected surfaces is seen, their edges do not excuse the difference.
  const int excused = std::min(passed, seen);
  return expected() > 0 ? static_cast<double>(seen) / (expected() - excused) : 1.0;
}

double Agreement::share_of_returns() const {
  const int returns = seen + hidden + beyond + unknown;
  return returns > 0 ? static_cast<double>(seen) / returns : (expected() > 0 ? 0.0 : 1.0);
}

bool Agreement::is_expected() const { return expected() >= kMinEvidence && share_of_both() >= kExpectedShare; }

bool Agreement::is_contradicted() const {
  return through() >= kMinContradicted && through() >= kContradictedShare * expected();
}

bool Agreement::is_expected_so_far() const {
  return expected() >= kMinEvidenceSoFar && share_of_expected() >= kExpectedShareSoFar;
}

Agreement agreement_of(const Sweep& sweep, const ViewPose& view, const SurfelMap& map, double tolerance_m) {
  const PoseVector eye = compose(view.pose, sweep.mount);
  const ExpectedView expected(eye.head<2>(), map.surfels(), sweep.range_max_m);
  Agreement agreement;
  const auto beams = static_cast<int>(sweep.ranges_m.size());
  const int stride = std::max(1, static_cast<int>(kBeamStepRad / std::abs(sweep.angle_increment_rad)));
  const double turn = view.turn.at_last_beam_rad - view.turn.at_first_beam_rad;
  for (int beam = 0; beam < beams; beam += stride) {
    const double turned = view.turn.at_first_beam_rad + turn * beam / beams;
    const double angle = eye.z() + turned + sweep.angle_min_rad + beam * sweep.angle_increment_rad;
    const double measured = sweep.ranges_m[static_cast<std::size_t>(beam)];
    if (!(measured >= sweep.range_min_m && measured > 0.0)) {
      // Not a number, or too near (REP-117): no information.
      continue;
    }
    const double shown = measured <= sweep.range_max_m ? measured : kNothing;
    const double angle_in_base = sweep.mount.z() + sweep.angle_min_rad + beam * sweep.angle_increment_rad;
    const double climb = view.slope.dot(Eigen::Vector2d(std::cos(angle_in_base), std::sin(angle_in_base)));
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    count(expected, map, {bin_of(angle), eye.head<2>(), direction, shown, climb, view.slope_sigma}, tolerance_m,
          agreement);
  }
  return agreement;
}

}  // namespace mtr_localization
