/// @file
/// One check for each part of the robot.
// SPDX-License-Identifier: Apache-2.0
#include "core/rows.hpp"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace mtr_rviz {
namespace {

/// Battery limits: below the first one, tests are not started; below the second one, there is a warning, as in the
/// application.
constexpr double kEmptyBattery = 0.10;
constexpr double kLowBattery = 0.25;
/// Longer than a working day, in which cables, mounts and clocks may have been changed.
constexpr double kOldPreflightS = 12.0 * 3600.0;

std::string number(double value, int digits) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

std::string duration(double seconds) {
  return seconds < 90.0     ? number(seconds, 0) + " s"
         : seconds < 5400.0 ? number(seconds / 60.0, 0) + " min"
                            : number(seconds / 3600.0, 0) + " h";
}

/// Returns the sentence, or the alternative if it is empty.
std::string or_else(const std::string& sentence, const std::string& otherwise) {
  return sentence.empty() ? otherwise : sentence;
}

template <typename T>
Row silent_row(const std::string& name, const Heard<T>& heard, double now_s) {
  return {name, std::isnan(heard.at_s) ? Level::kUnknown : Level::kBad, silence(heard.at_s, now_s)};
}

}  // namespace

std::string sign_of(Level level) {
  switch (level) {
    case Level::kGood:
      return "\u2713";
    case Level::kNote:
      return "!";
    case Level::kBad:
      return "\u2715";
    default:
      return "?";
  }
}

bool is_fresh(double at_s, double now_s) { return now_s - at_s <= kSilentAfterS; }

std::string silence(double at_s, double now_s) {
  return std::isnan(at_s) ? "Never heard." : "Silent for " + duration(now_s - at_s) + ".";
}

Row pose_row(const Heard<PoseSaid>& heard, double now_s) {
  const std::string name = "Localization";
  if (!is_fresh(heard.at_s, now_s)) {
    return silent_row(name, heard, now_s);
  }
  if (!heard.said.is_valid) {
    return {name, Level::kBad, or_else(heard.said.message, "The pose is not valid.")};
  }
  return {name, Level::kGood, "Within " + number(1000.0 * heard.said.sigma_m, 0) + " mm (1 sigma)."};
}

Row car_row(const Heard<CarSaid>& heard, double now_s) {
  const std::string name = "Car";
  if (!is_fresh(heard.at_s, now_s)) {
    return silent_row(name, heard, now_s);
  }
  const CarSaid& said = heard.said;
  switch (said.state) {
    case CarSaid::State::kLocated:
      return {name, Level::kGood, number(said.length_m, 2) + " m by " + number(said.width_m, 2) + " m."};
    case CarSaid::State::kCollecting:
      return {name, Level::kNote, or_else(said.message, "Is being mapped.")};
    case CarSaid::State::kFailed:
      return {name, Level::kBad, or_else(said.message, "Was not found.")};
    default:
      return {name, Level::kUnknown, or_else(said.message, "Not mapped yet.")};
  }
}

Row self_check_row(const Heard<SelfCheckSaid>& heard, double now_s) {
  const std::string name = "Self-check";
  if (!is_fresh(heard.at_s, now_s)) {
    return silent_row(name, heard, now_s);
  }
  const SelfCheckSaid& said = heard.said;
  const std::string figure = std::isnan(said.difference_m) ? ""
                                                           : number(1000.0 * said.difference_m, 0) + " mm of " +
                                                                 number(1000.0 * said.limit_m, 0) + " mm allowed.";
  switch (said.state) {
    case SelfCheckSaid::State::kPassed:
      return {name, Level::kGood, or_else(figure, "Passed.")};
    case SelfCheckSaid::State::kFailed:
      return {name, Level::kBad, or_else(said.message, or_else(figure, "Failed."))};
    case SelfCheckSaid::State::kRunning:
      return {name, Level::kNote, "Under way."};
    default:
      return {name, Level::kUnknown, "None made."};
  }
}

Row motion_row(const Heard<MotionSaid>& heard, double now_s) {
  const std::string name = "Motion planner";
  if (!is_fresh(heard.at_s, now_s)) {
    return silent_row(name, heard, now_s);
  }
  const MotionSaid& said = heard.said;
  switch (said.result) {
    case MotionSaid::Result::kPending:
      return {name, Level::kGood, number(said.remaining_m, 1) + " m to go."};
    case MotionSaid::Result::kReached:
      return {name, Level::kGood, "At its goal."};
    case MotionSaid::Result::kRefused:
      return {name, Level::kBad, or_else(said.message, "Cannot go there.")};
    case MotionSaid::Result::kBlocked:
      return {name, Level::kNote, or_else(said.message, "Waits for an obstacle.")};
    default:
      return {name, Level::kGood, "No goal."};
  }
}

Row drive_row(const Heard<DriveSaid>& heard, double now_s) {
  const std::string name = "Wheels";
  if (!is_fresh(heard.at_s, now_s)) {
    return silent_row(name, heard, now_s);
  }
  const DriveSaid& said = heard.said;
  std::string text = said.source + ", " + number(said.linear_mps, 2) + " m/s.";
  if (!std::isnan(said.obstacle_m)) {
    text += " Something " + number(said.obstacle_m, 2) + " m away.";
  }
  switch (said.zone) {
    case DriveSaid::Zone::kBlind:
      return {name, Level::kBad, or_else(said.message, text)};
    case DriveSaid::Zone::kSlowed:
    case DriveSaid::Zone::kBlocked:
      return {name, Level::kNote, or_else(said.message, text)};
    default:
      return {name, said.message.empty() ? Level::kGood : Level::kNote, or_else(said.message, text)};
  }
}

Row parts_row(const Heard<PartsSaid>& heard, double now_s) {
  const std::string name = "Lift and buttons";
  if (!is_fresh(heard.at_s, now_s)) {
    return silent_row(name, heard, now_s);
  }
  if (!heard.said.is_alive) {
    return {name, Level::kBad, or_else(heard.said.message, "The firmware is silent.")};
  }
  const std::string text = "Key at " + number(heard.said.key_height_m, 2) + " m.";
  return {name, heard.said.message.empty() ? Level::kGood : Level::kNote, or_else(heard.said.message, text)};
}

Row battery_row(const Heard<PartsSaid>& heard, double now_s) {
  const std::string name = "Battery";
  if (!is_fresh(heard.at_s, now_s) || std::isnan(heard.said.battery)) {
    return {name, Level::kUnknown, "Not known."};
  }
  const double charge = heard.said.battery;
  const Level level = charge < kEmptyBattery ? Level::kBad : charge < kLowBattery ? Level::kNote : Level::kGood;
  return {name, level, number(100.0 * charge, 0) + " %."};
}

Row preflight_row(const std::optional<Preflight>& preflight) {
  const std::string name = "Preflight";
  if (!preflight) {
    return {name, Level::kUnknown, "Never made since the robot was started."};
  }
  const std::string of = " of " + std::to_string(preflight->checks);
  const std::string ago = ", " + duration(preflight->age_s) + " ago.";
  if (preflight->bad > 0) {
    return {name, Level::kBad, std::to_string(preflight->bad) + of + " wrong" + ago + " " + preflight->first_bad};
  }
  return {name, preflight->age_s > kOldPreflightS ? Level::kNote : Level::kGood,
          std::to_string(preflight->checks) + of + " right" + ago};
}

}  // namespace mtr_rviz
