/// @file
/// One error of a sensor; the values are in sensor_figures.hpp, generated from mtr_core/sensor_figures.py. No ROS.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mtr_core/parameter.hpp"

namespace mtr_core {

/// Value of one error with the range that a parameter may have, ends included, and the unit of all three.
struct SensorFigure {
  double value;
  double low;
  double high;
  const char* unit;
};

/// Row of a parameter with the range and unit of a figure.
template <typename P>
constexpr ParameterRow<P> row_of(const char* name, double P::*member, const SensorFigure& figure) {
  return {name, member, figure.low, figure.high, figure.unit};
}

}  // namespace mtr_core
