/// @file
/// Rounds of the adjustment from coarse to fine.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_surfel_map/adjustment/map_adjustment.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "adjustment/checks.hpp"
#include "adjustment/problem.hpp"
#include "extraction/free_space.hpp"
#include "extraction/surfel_builder.hpp"

namespace mtr_surfel_map {
namespace {

/// Length limits of one round, in m.
struct Round {
  double max_surfel_m;
  double min_surfel_m;
  /// Largest root mean square distance of the points of a surface from it.
  double thickness_m;
  /// Association gate: largest distance of a return from the surface to which it is assigned.
  double gate_m;
};

// The first rounds remove a drift of up to 0.6 m; the last one resolves bumpers and wheels.
constexpr std::array<Round, 4> kCoarse{{
    {1.2, 0.6, 0.25, 0.6},
    {0.8, 0.4, 0.12, 0.3},
    {0.6, 0.2, 0.06, 0.15},
    {0.4, 0.1, 0.04, 0.10},
}};
constexpr double kMaxFineSurfelM = 0.4;
constexpr double kMinFineSurfelM = 0.1;
// Limits in multiples of the range sigma. Stationary surfaces are not thicker, and their returns are not farther away.
constexpr double kFineThickness = 2.0;
constexpr double kFineGate = 5.0;
constexpr int kMaxFineRounds = 6;
// Iteration ends when no pose moves by more than this in a round.
constexpr double kSettledM = 0.0003;
// Lower bound of the bias sigma. A tilted scan plane meets leaning surfaces at a shorter or longer range, which
// resembles a bias. Measured with 1 degree of tilt and sides that lean by 1 in 5.
constexpr double kMinBiasSigmaM = 0.003;
// Shape error of a surfel as a share of the shape error of one view. Views from all sides have a part of it in common.
constexpr double kShapeShare = 0.5;
// Shift of the grid from round to round, as a share of the largest square. A surface cut by a square border in one
// round is whole in the next.
constexpr double kShift = 0.38;

Round fine_round(const AdjustmentParameters& parameters) {
  return {kMaxFineSurfelM, kMinFineSurfelM, kFineThickness * parameters.range_noise_m,
          kFineGate * parameters.range_noise_m};
}

std::vector<Surfel> surfels_of(const Adjustment& state, const Round& round, int number) {
  const double shift = std::fmod(kShift * number, 1.0) * round.max_surfel_m;
  return build_surfels(points_in_map(state.key_frames, state.range_bias),
                       {round.max_surfel_m, round.min_surfel_m, round.thickness_m, {shift, shift}});
}

std::vector<Observation> observe(const Adjustment& state, double gate_m, const AdjustmentParameters& parameters) {
  return observe(state.key_frames, state.range_bias, SurfelMap(state.surfels), gate_m, parameters);
}

/// Runs one round and returns the largest position change of a pose.
double do_round(Adjustment& state, const Round& round, int number, const AdjustmentParameters& parameters) {
  state.surfels = surfels_of(state, round, number);
  const std::vector<Observation> observations = observe(state, round.gate_m, parameters);
  const double moved_m = solve(state, observations, parameters);
  // Inflate the motion covariance: wheels that slip more than their parameters specify must not bend the map.
  state.motion_factor = std::max(1.0, fit_of(state, observations).motion_ratio);
  return moved_m;
}

/// Drops surfels that beams passed through, repeats the association and the adjustment, and returns the observations.
std::vector<Observation> finish(Adjustment& state, const AdjustmentParameters& parameters) {
  state.surfels = without_seen_through(state.surfels, state.key_frames);
  std::vector<Observation> observations = observe(state, fine_round(parameters).gate_m, parameters);
  solve(state, observations, parameters);
  return observations;
}

/// Sets the number of hits and the range of hit heights of each surfel from all views.
std::vector<Surfel> as_seen(std::vector<Surfel> surfels, const std::vector<Observation>& observations) {
  for (Surfel& surfel : surfels) {
    surfel.hits = 0;
  }
  for (const Observation& seen : observations) {
    Surfel& surfel = surfels[static_cast<std::size_t>(seen.surfel)];
    const bool is_first = surfel.hits == 0;
    surfel.lowest_rise_m = is_first ? seen.lowest_rise_m : std::min(surfel.lowest_rise_m, seen.lowest_rise_m);
    surfel.highest_rise_m = is_first ? seen.highest_rise_m : std::max(surfel.highest_rise_m, seen.highest_rise_m);
    surfel.hits += seen.beams;
  }
  return surfels;
}

AdjustedMap result_of(const Adjustment& state, const std::vector<Observation>& observations,
                      const AdjustmentParameters& parameters) {
  const Uncertainty uncertainty = uncertainty_of(state, observations, parameters);
  const Fit fit = fit_of(state, observations);
  // Residuals larger than their sigmas show that the sigmas are too small.
  const double factor = std::max(1.0, fit.surface_ratio);
  AdjustedMap map;
  map.key_frames = state.key_frames;
  for (const Eigen::Matrix3d& covariance : uncertainty.poses) {
    map.pose_covariances.emplace_back(factor * factor * covariance);
  }
  const std::vector<Surfel> surfels = as_seen(state.surfels, observations);
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    if (surfels[i].hits > 0) {
      map.surfels.push_back(surfels[i]);
      map.surfels.back().sigma_m =
          std::hypot(factor * uncertainty.surfels_m[i], kShapeShare * parameters.surface_sigma_m);
      map.surfels.back().lean_sigma = std::clamp(factor * uncertainty.leans[i], kBendSigma, kLeanSigma);
    }
  }
  map.range_bias = state.range_bias;
  // Tilt and leaning surfaces affect all LiDARs alike, so this error is fully correlated.
  map.range_bias.covariance = (factor * factor * uncertainty.range_bias).array() + kMinBiasSigmaM * kMinBiasSigmaM;
  map.message = problem_with(state, observations, fit, parameters);
  map.valid = !map.message;
  return map;
}

AdjustedMap no_map(const std::vector<KeyFrame>& key_frames, const mtr_core::Problem& message) {
  AdjustedMap map;
  map.key_frames = key_frames;
  map.pose_covariances.assign(key_frames.size(), Eigen::Matrix3d::Zero());
  map.message = message;
  return map;
}

}  // namespace

AdjustedMap adjust(const std::vector<KeyFrame>& key_frames, const AdjustmentParameters& parameters) {
  check(parameters);
  if (const mtr_core::Problem problem = problem_with(key_frames)) {
    return no_map(key_frames, problem);
  }
  Adjustment state;
  state.key_frames = key_frames;
  int number = 0;
  for (const Round& round : kCoarse) {
    do_round(state, round, number++, parameters);
  }
  for (int fine = 0; fine < kMaxFineRounds; ++fine) {
    if (do_round(state, fine_round(parameters), number++, parameters) < kSettledM) {
      break;
    }
  }
  const std::vector<Observation> observations = finish(state, parameters);
  return result_of(state, observations, parameters);
}

}  // namespace mtr_surfel_map
