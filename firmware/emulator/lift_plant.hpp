/// @file
/// The lift as a mechanism: motor, spindle, stops and position sensor.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>

namespace emulator {

struct LiftParameters {
  double stroke_m = 1.2;
  /// Unloaded, at full duty.
  double speed_mps = 0.2;
  /// Share of the speed that is left upwards, against the load.
  double upwards = 0.92;
  /// Motor and spindle follow with this delay.
  double lag_s = 0.05;
  /// Duty below which nothing moves.
  double friction_duty = 0.09;
  /// Sensor at the lower and at the upper stop.
  double low_mv = 250.0;
  double high_mv = 4750.0;
  /// Evenly distributed, to either side.
  double noise_mv = 3.0;
};

/// A spindle holds its place without power.
class LiftPlant {
 public:
  LiftPlant(const LiftParameters& parameters, std::uint32_t seed) : parameters_(parameters), random_(seed) {}

  /// Lets time pass with a duty of -1 to 1.
  void step(double duty, double dt_s);

  /// Reading of the sensor, with noise.
  double sensor_mv();

  void jam(bool is_jammed) { is_jammed_ = is_jammed; }
  void break_wire(bool is_broken) { is_broken_ = is_broken; }
  double height_m() const { return height_m_; }

 private:
  LiftParameters parameters_;
  std::mt19937 random_;
  double height_m_ = 0.0;
  double speed_mps_ = 0.0;
  bool is_jammed_ = false;
  bool is_broken_ = false;
};

}  // namespace emulator
