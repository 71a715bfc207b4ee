/// @file
/// Entry point of the localization node.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_core/run_node.hpp"
#include "ros/node.hpp"

int main(int argc, char** argv) { return mtr_core::run_node<mtr_localization::Node>(argc, argv, "localization"); }
