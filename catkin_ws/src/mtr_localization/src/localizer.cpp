/// @file
/// One step of localization, from one wheel sample to the next.
// SPDX-License-Identifier: Apache-2.0
#include "localizer.hpp"

#include <malloc.h>

#include <algorithm>
#include <utility>

#include "mtr_surfel_map/adjustment/map_adjustment.hpp"
#include "problems.hpp"
#include "scans/deskew.hpp"

namespace mtr_localization {
namespace {

// The LiDARs count as silent after this time without a scan: seven sweeps at 25 Hz, three at 10 Hz.
constexpr std::int64_t kSilentNs = 300'000'000;
// Without LiDARs the robot could be carried unnoticed, but not within a short time. A LiDAR or driver that restarts
// within this time does not invalidate the pose.
constexpr std::int64_t kMaxBlindNs = 5'000'000'000;
// Additional uncertainty of the pose at the transition from the growing to the adjusted map.
constexpr double kEntrySigmaM = 0.02;
constexpr double kEntrySigmaRad = 0.005;

// Initial uncertainty at the origin of a map, from wheels and tyres at rest; it must not be zero.
constexpr double kRestSigmaM = 0.001;
constexpr double kRestSigmaRad = 0.0005;

double square(double value) { return value * value; }

// Uncertainty of a motion that the wheels did not measure either; the LiDARs determine it.
const Eigen::Matrix3d kUnseenWay = Eigen::Matrix3d::Identity();

Mapper::Adjust adjustment_with(const Parameters& parameters) {
  return [adjustment = parameters.adjustment](const std::vector<KeyFrame>& key_frames) {
    AdjustedMap map = mtr_surfel_map::adjust(key_frames, adjustment);
    // The adjustment allocates about 30 MiB for seconds; without trimming, glibc would keep it, and more after each
    // map.
    malloc_trim(0);
    return map;
  };
}

}  // namespace

Localizer::Localizer(const Parameters& parameters)
    : PoseSource(parameters, adjustment_with(parameters)), tracker_(parameters.tracking) {}

void Localizer::go_on(Memory memory) {
  mapper().go_on(memory.map_car_id, memory.revision);
  memory_ = std::move(memory);
}

Estimate Localizer::step(const GatedSample& sample) {
  const std::int64_t now_ns = sample.wheels.stamp_ns;

  // Predict with wheels and gyro.
  const RememberedPose before{filter().pose(), filter().pose_covariance(), odometry().wheel_odom()};
  const PoseVector odom_before = history().newest().odom;
  if (const mtr_core::Problem loss = odometry().predict(sample, gyro(), tracker_.has_map())) {
    bridge(before, odom_before, sample, loss);
  }
  mapper().travel(history().newest().input, filter().pose().z(), tracker_.lost());

  // Resume with the previous map after the gyro bias is known.
  if (memory_ && odometry().state() == MotionState::kTracking) {
    take_up(*memory_);
    memory_.reset();
  }

  // Start a map on order, and use it once it is adjusted and trustworthy.
  if (mapper().begins(now_ns)) {
    begin_map();
  }
  if (const AdjustedMap* adjusted = mapper().finish(now_ns)) {
    adjusted->valid ? enter(*adjusted) : leave(*adjusted);
  }

  // Apply the corrections.
  correct_by_scans();
  correct_by_satellites();
  doubt_blind_pose();
  return estimate();
}

bool Localizer::correct_by_scans() {
  const std::vector<ScanSet> sets = scans().take_due(history());
  for (const ScanSet& set : sets) {
    const ScanPoints scan = deskew(set, history());
    const Judgement judgement = tracker_.judge(set, history());
    if (judgement == Judgement::kAgrees) {
      correct(set.step, scan);
    } else if (judgement == Judgement::kLost) {
      relocalize(set, scan);
    }
    if (std::any_of(set.sweeps.begin(), set.sweeps.end(), [](const Sweep& sweep) { return sweep.says_anything(); })) {
      last_scan_ns_ = scan.stamp_ns;
    }
    if (!tracker_.lost()) {
      map(set.step, scan);
    }
  }
  return !sets.empty();
}

void Localizer::correct(std::size_t step, const ScanPoints& scan) {
  ScanMatch match = tracker_.match(scan, history().at(step).filter);
  if (ScanTracker::is_enough(match) && match.contradicts(history().at(step).filter.pose_covariance())) {
    // Unmodelled motion (pushed or slipping): inflate the prior.
    const Eigen::Matrix3d surprise = match.shift().cwiseAbs2().asDiagonal();
    history().change(step, [&](PoseFilter& filter) { filter.add_pose_noise(surprise); });
    match = tracker_.match(scan, history().at(step).filter);
  }
  if (tracker_.fits(scan, history().at(step)) && tracker_.accept(match)) {
    history().change(step, [&](PoseFilter& filter) { filter.correct(match.correction); });
  }
}

void Localizer::relocalize(const ScanSet& set, const ScanPoints& scan) {
  if (const auto found = tracker_.relocalize(set, scan, history())) {
    history().change(set.step, [&](PoseFilter& filter) { filter.set_pose(found->pose, found->covariance); });
  }
}

void Localizer::map(std::size_t step, const ScanPoints& scan) {
  const FilterStep& here = history().at(step);
  const KeyFrame* frame =
      mapper().add({scan, here.filter.pose(), here.odom, odometry().standing(), here.filter.gyro_bias_sigma_radps()});
  if (frame != nullptr) {
    tracker_.extend(*frame);
  }
}

void Localizer::correct_by_satellites() {
  if (const mtr_core::Problem contradiction = gnss_.use_due(tracker_, history())) {
    tracker_.lose(contradiction);
  }
}

void Localizer::doubt_blind_pose() {
  if (!is_blind() || tracker_.lost() || tracker_.surfaces().surfels().empty()) {
    return;
  }
  const std::int64_t confirmed_ns = std::max(last_scan_ns_, gnss_.agreed_ns());
  if (history().newest().stamp_ns - confirmed_ns > kMaxBlindNs || tracker_.is_too_uncertain(filter())) {
    tracker_.doubt(problems::kDoubted({{"cause", problems::kBlind()}}), true);
  }
}

void Localizer::take_up(const Memory& memory) {
  // Without a pose, the search covers the middle of the map.
  const auto led = memory.pose ? led_by_wheels(*memory.pose, odometry().wheel_odom()) : std::nullopt;
  const RememberedPose here = led.value_or(memory.pose.value_or(RememberedPose{}));
  history().change_newest([&here](PoseFilter& filter) { filter.set_pose(here.pose, here.covariance); });
  if (memory.pose && memory.pose->origin_id != 0) {
    set_origin(memory.pose->origin_id);
  }
  const int sources = tracker_.enter(memory.map, history().newest());
  history().change_newest([sources](PoseFilter& filter) { filter.consider_sources(sources); });
  history().forget_past();
  const mtr_core::Sentence& sentence = led ? problems::kDoubted : problems::kSearching;
  tracker_.doubt(sentence({{"cause", problems::kStartedAnew()}}), static_cast<bool>(led));
}

void Localizer::begin_map() {
  memory_.reset();
  if (tracker_.lost()) {
    // The origin of a map defines its frame, so the uncertainty of the previous pose does not carry over.
    history().change_newest([](PoseFilter& filter) { filter.set_pose(filter.pose(), Eigen::Matrix3d::Zero()); });
    set_origin(static_cast<std::uint64_t>(history().newest().stamp_ns));
  }
  tracker_.begin_map(history().newest());
  last_scan_ns_ = std::max(last_scan_ns_, history().newest().stamp_ns);
  history().change_newest([](PoseFilter& filter) { filter.consider_sources(0); });
  history().forget_past();
  odometry().begin_map();
  gnss_.clear();
}

void Localizer::enter(const AdjustedMap& map) {
  // Append the tracked motion since the last key frame to its adjusted pose.
  const PoseVector since = relative(key_frames().back().pose, filter().pose());
  const PoseVector pose = compose(map.key_frames.back().pose, since);
  Eigen::Matrix3d covariance = map.pose_covariances.back();
  covariance.diagonal() += Eigen::Vector3d(square(kEntrySigmaM), square(kEntrySigmaM), square(kEntrySigmaRad));
  history().change_newest([&](PoseFilter& filter) { filter.set_pose(pose, covariance); });
  const int sources = tracker_.enter(map, history().newest());
  history().change_newest([sources](PoseFilter& filter) { filter.consider_sources(sources); });
  history().forget_past();
}

void Localizer::leave(const AdjustedMap& refused) {
  // The growing map and its poses are based on the rejected key frames.
  tracker_.give_up(problems::kMapRefused({{"cause", refused.message}}));
  history().change_newest([](PoseFilter& filter) { filter.consider_sources(0); });
}

void Localizer::bridge(const RememberedPose& before, const PoseVector& odom_before, const GatedSample& sample,
                       const mtr_core::Problem& loss) {
  const std::optional<double> turn_rad = turn_of(sample);
  const auto way =
      led_by_wheels({odom_before, Eigen::Matrix3d::Zero(), before.wheel_odom}, odometry().wheel_odom(), turn_rad);
  if (way) {
    odometry().lead(way->pose);
  }
  mapper().lead(way ? way->covariance : kUnseenWay);
  const auto led = tracker_.is_reckoned() ? led_by_wheels(before, odometry().wheel_odom(), turn_rad) : std::nullopt;
  if (led) {
    history().change_newest([&led](PoseFilter& filter) { filter.set_pose(led->pose, led->covariance); });
    tracker_.lead(history().newest());
  }
  if (tracker_.state() == ScanTracker::State::kMapping) {
    tracker_.lose(problems::kLost({{"cause", loss}}));
  } else if (led) {
    tracker_.doubt(problems::kDoubted({{"cause", loss}}), true);
  } else {
    tracker_.lose(problems::kSearching({{"cause", loss}}));
  }
}

std::optional<double> Localizer::turn_of(const GatedSample& sample) const {
  if (!sample.turn_meanwhile) {
    return std::nullopt;
  }
  const auto& [duration_s, angle_rad] = *sample.turn_meanwhile;
  return duration_s * filter().corrected_rate(angle_rad / duration_s);
}

PoseFigures Localizer::figures() const {
  PoseFigures figures = PoseSource::figures();
  figures.tracking = tracker_.figures();
  figures.gnss = gnss_.figures();
  return figures;
}

Estimate Localizer::estimate() const {
  const bool is_tracking = odometry().state() == MotionState::kTracking;
  mtr_core::Problem problem = is_tracking ? tracker_.lost_reason() : odometry().problem();
  if (!problem && has_seen_nothing()) {
    problem = problems::kBlind();
  }
  Estimate estimate = answer(history().newest().stamp_ns, problem);
  estimate.degenerate = tracker_.degenerate() || is_blind();
  return estimate;
}

bool Localizer::is_blind() const {
  return tracker_.has_map() && history().newest().stamp_ns - last_scan_ns_ > kSilentNs;
}

bool Localizer::has_seen_nothing() const {
  return tracker_.state() == ScanTracker::State::kMapping && tracker_.surfaces().surfels().empty() &&
         history().newest().stamp_ns - last_scan_ns_ > kMaxBlindNs;
}

Estimate Localizer::pose_at(std::int64_t stamp_ns) const {
  Eigen::Matrix3d covariance = filter().pose_covariance();
  if (tracker_.state() == ScanTracker::State::kMapping) {
    covariance += mapper().drift_covariance();
  }
  if (tracker_.state() != ScanTracker::State::kLocalized) {
    covariance.diagonal() += Eigen::Vector3d(square(kRestSigmaM), square(kRestSigmaM), square(kRestSigmaRad));
  }
  Estimate estimate = estimate_of(stamp_ns, filter().pose(), covariance);
  estimate.mode = mode();
  return estimate;
}

PoseMode Localizer::mode() const {
  if (odometry().state() == MotionState::kLost || tracker_.lost()) {
    return PoseMode::kLost;
  }
  switch (tracker_.state()) {
    case ScanTracker::State::kMapping:
      return PoseMode::kMapping;
    case ScanTracker::State::kLocalized:
      return PoseMode::kLocalized;
    default:
      return PoseMode::kDeadReckoning;
  }
}

}  // namespace mtr_localization
