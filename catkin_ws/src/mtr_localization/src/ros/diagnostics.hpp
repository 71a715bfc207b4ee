/// @file
/// Diagnostic status of localization for /diagnostics.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>

#include "figures.hpp"
#include "ros/work_load.hpp"
#include "samples.hpp"

namespace mtr_localization {

/// Returns one status: OK while valid, a warning while waiting or degenerate, an error when lost.
diagnostic_msgs::DiagnosticArray diagnostics_of(const PoseFigures& figures, const Estimate& estimate,
                                                const WorkLoad& load);

}  // namespace mtr_localization
