# Everything a developer does; `make help` lists it. Each target installs and builds first what it needs.
# SPDX-License-Identifier: Apache-2.0
SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.PHONY: help setup build demo test lint unit firmware-test rostest system sim gui screenshots translations wheels clean \
	bench bench-kills fuzz fuzz-commands hostile-texts bench-motion bench-clearance bench-lidar bench-localization bench-range bench-gui bench-stalls bench-real-time \
	bench-truth red-team sanitize bench-link bench-real bench-results bench-campaign browser-test bench-faults fault-matrix soak bench-can gazebo try-cars firmware flash bare-root noetic-root \
	noetic-container docs tidy mutants

SEED ?= 1
# Simulated seconds per second for `make sim`; 0 is as fast as the control loop allows.
FACTOR ?= 1
# Of demo, sim and gui, the simulated Car: gentle, honest, honest_868, honest_button, honest_handle, honest_slow, or a
# file's path. The demo shows what a range is worth; a person who tries the window wants it short.
ifeq ($(origin CAR),undefined)
CAR := gentle
demo: CAR := honest
endif
# For `make demo`, what is run: autolock key_press zone_map handle_request; empty: those that suit the Car.
SCENARIOS ?=
# Of demo and sim: fake (simulated in the simulator) or emulated (the flashed firmware on an emulated board).
PERIPHERALS ?= fake
# For `make flash`: mega or uno, and its serial port.
BOARD ?= mega
PORT ?=
# For `make bench-kills`: how many of each scenario, of the application and of the robot's nodes.
KILLS ?= 1000
NODE_KILLS ?= 100
# For `make bench-clearance`: how many Cars.
CARS ?= 200
RVIZ ?= $(if $(DISPLAY),true,false)

STAMPS := .setup
FIRMWARE_ELF := $(CURDIR)/firmware/build/mtr_firmware_atmega2560.elf
EMULATED := $(filter emulated,$(PERIPHERALS))
# The nodes work in another folder.
CAR_OF_NODES := $(if $(filter %.yaml,$(CAR)),$(abspath $(CAR)),$(CAR))
RUN := source setup/env.bash &&
BUILD_INPUTS := $(shell find catkin_ws/src proto launch tests -not -path '*/.*' \( -name CMakeLists.txt -o -name package.xml \
	-o -name setup.py -o -name '*.msg' -o -name '*.proto' -o -name '*.cpp' -o -name '*.hpp' -o -path '*/scripts/*' \) \
	-type f 2>/dev/null)

help: ## List the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## /{printf "  make %-18s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

setup: ## Install the missing Debian and Python packages
	@setup/install.sh

build: $(STAMPS)/build ## Build the proto and the catkin workspace

# The stamp is as old as the beginning: what is changed meanwhile is younger.
$(STAMPS)/build: $(BUILD_INPUTS) setup/debian-packages.txt setup/python-requirements.txt | setup
	@touch $@.begun
	@setup/build.sh
	@mv $@.begun $@

demo: setup build $(if $(EMULATED),firmware) ## Run scenarios on the simulated robot and Car, beside the truth; results in out/demo, in a store too
	@$(RUN) python -m mtr_simulation.demo --seed $(SEED) --car $(CAR) --out out/demo $(if $(SCENARIOS),--scenarios $(SCENARIOS)) \
		$(if $(EMULATED),--firmware $(FIRMWARE_ELF))

sim: setup build $(if $(EMULATED),firmware) ## Start the simulated robot and Car for an application on ports 3333 and 3334 (Ctrl-C ends)
	@mkdir -p out/sim
	@$(RUN) roslaunch mtr_bringup sim.launch seed:=$(SEED) car:=$(CAR_OF_NODES) real_time_factor:=$(FACTOR) rviz:=$(RVIZ) \
		car_port_link:=$(CURDIR)/out/sim/can truth_dir:=$(CURDIR)/out/sim $(if $(EMULATED),firmware_elf:=$(FIRMWARE_ELF))

gui: setup build ## Open the Operator's window, filled in for the robot and Car of `make sim`
	@$(RUN) mtr-operator window --robot 127.0.0.1 --subscriber-port 3334 --publisher-port 3333 --can-interface slcan \
		--can-channel $(CURDIR)/out/sim/can --can-bitrate 500000 \
		--car-profile "$$(python -c 'from mtr_simulation.car.choice import chosen_car; print(chosen_car("$(CAR)").profile)')"

screenshots: setup build ## Pictures of every window in each theme, language and size, with contact sheets; in out/screenshots
	@$(RUN) xvfb-run -a -s "-screen 0 1440x1000x24 -nolisten tcp" \
		env QT_QPA_PLATFORM=xcb python tests/system/gui_screenshots.py out/screenshots

try-cars: setup build ## Profiles of three real cars on a simulated Car that speaks their frames: DBC=folder of their databases
	@test -n "$(DBC)" || { echo "make try-cars needs DBC=FOLDER, the folder of the cars' CAN databases; they are no part of the project."; exit 2; }
	@$(RUN) mtr-operator try operator_gui/examples/cars/*.yaml --databases $(DBC)
	@$(RUN) MTR_CAR_DATABASES=$(abspath $(DBC)) python -m pytest -q operator_gui/tests/unit/test_car_try.py

translations: ## Collect the window's texts, compile the translations
	@cd operator_gui/src/mtr_operator/gui && pylupdate5 -noobsolete $$(find . ../station/checks -name '*.py' | sort) \
		-ts translations/mtr_operator_cs.ts 2>/dev/null
	@cd operator_gui/src/mtr_operator/gui && lrelease -silent translations/mtr_operator_cs.ts

wheels: setup ## The application and its contract as wheels for any laptop, in out/wheels
	@$(RUN) python -m pip wheel --quiet --no-deps -w out/wheels proto/ operator_gui/

test: setup build ## Lint, layer test, unit tests, firmware, rostest suites and system tests
	@$(RUN) python setup/run_tests.py all

lint: setup build ## Only the lint
	@$(RUN) python setup/run_tests.py lint

tidy: setup build ## Look for defects in all C++ with clang-tidy; some minutes. TIDY="words of paths" looks at less
	@$(RUN) python setup/tidy.py $(TIDY)

unit: setup build ## Only the tests that need no ROS master
	@$(RUN) python setup/run_tests.py lint unit window gtest

firmware-test: setup build ## Only the tests of the firmware, on the PC and on the emulated boards
	@$(RUN) python setup/run_tests.py firmware

rostest: setup build ## Only the rostest suites
	@$(RUN) python setup/run_tests.py rostest

system: setup build ## Only the tests of the whole stack
	@$(RUN) python setup/run_tests.py system

mutants: setup build ## Mutation tests of the pure cores; MUTANTS takes options, see tests/mutation
	@$(RUN) python -m pip install --quiet --no-warn-conflicts --upgrade --target out/mutants/tools -r tests/mutation/requirements.txt
	@$(RUN) python tests/mutation/run.py $(MUTANTS)

# What a stranger's machine shall do: the targets of BARE, in a root that has only git, make and sudo.
BARE ?= test
bare-root: ## The whole test on a fresh clone in a fresh Debian 12; needs root and debootstrap
	@setup/bare_root.sh $(BARE)

# Parts of the proof, all without but gazebo: declared build unit gtest rostest drive gazebo. KEEP=FOLDER keeps the Debian 11 for the next run.
NOETIC ?=
noetic-root: ## The robot's packages on Noetic's platform: an empty catkin workspace in a fresh Debian 11; needs root and debootstrap
	@setup/noetic_root.sh $(NOETIC)

noetic-container: ## The same in ros:noetic; needs podman or docker
	@setup/noetic_root.sh container $(NOETIC)

docs: setup build ## API pages of all packages, in out/docs
	@setup/install.sh setup/debian-docs-packages.txt
	@$(RUN) setup/docs.sh

bench: setup build firmware ## Benchmarks of the simulation's speed and the serial line; figures in out/bench
	@$(RUN) failed=0; for part in simulation serial; do \
		python -m mtr_benchmarks.$$part --out out/bench || failed=1; done; exit $$failed

firmware: setup ## Build the firmware of both boards and its emulator; prints sizes
	@$(MAKE) --no-print-directory -s -C firmware all

flash: setup ## Write the firmware to a board: BOARD=mega|uno PORT=/dev/serial/by-id/...
	@$(MAKE) --no-print-directory -s -C firmware flash BOARD=$(BOARD) PORT=$(PORT)

bench-motion: setup build ## Benchmark of the robot's motion; figures in out/bench/motion.json
	@$(RUN) python -m mtr_benchmarks.motion --seed $(SEED) --out out/bench

# Set by a developer: --quick, --only NAME, --keep FOLDER, --kidnappings N, --kidnappings-only.
BENCH_OPTIONS ?=
bench-clearance: setup build ## Whole tests around 200 random Cars, swept against their true bodies; figures in out/bench/car_clearance.json; CARS=200
	@$(RUN) python -m mtr_benchmarks.car_clearance --cars $(CARS) --seed $(SEED) --out out/bench

bench-localization: setup build ## Localization and Car locator against the truth, odometry and MRPT's SLAM
	@setup/install.sh setup/debian-bench-packages.txt
	@cmake -S catkin_ws/src/mtr_benchmarks/mrpt_icp_slam -B out/bench/mrpt >/dev/null && cmake --build out/bench/mrpt >/dev/null
	@failed=0; $(if $(findstring -only,$(BENCH_OPTIONS)),,$(RUN) python -m mtr_benchmarks.localization.ends --out out/bench || failed=1;) \
		$(RUN) python -m mtr_benchmarks.localization --mrpt out/bench/mrpt/mrpt_icp_slam --out out/bench $(BENCH_OPTIONS) || failed=1; \
		exit $$failed

bench-real: setup build ## Localization on recordings of real robots, beside MRPT's SLAM: BAGS=folder of them; REAL_OPTIONS
	@test -n "$(BAGS)" || { echo "make bench-real needs BAGS=FOLDER, a folder of bags; the project has none of real robots."; exit 2; }
	@setup/install.sh setup/debian-bench-packages.txt
	@cmake -S catkin_ws/src/mtr_benchmarks/mrpt_icp_slam -B out/bench/mrpt >/dev/null && cmake --build out/bench/mrpt >/dev/null
	@$(RUN) python -m mtr_benchmarks.real $(BAGS) --mrpt out/bench/mrpt/mrpt_icp_slam --out out/bench $(REAL_OPTIONS)

RADIALS ?= 1000
# Of each kind of whole tests at the limit; 1000 of them take a night.
LIMIT_LINES ?= 48
bench-range: setup build ## Ranges of both scenarios on Cars that fade, lapse and poll; figures in out/bench/range.json
	@setup/install.sh setup/debian-range-packages.txt
	@$(RUN) python -m pip install --quiet --no-warn-conflicts --no-deps --upgrade --target out/bench/tools -r setup/range-requirements.txt
	@$(RUN) OPENBLAS_NUM_THREADS=1 PYTHONPATH=$$PYTHONPATH:$(CURDIR)/out/bench/tools \
		python -m mtr_benchmarks.ranges --seed $(SEED) --radials $(RADIALS) --axes $(RADIALS) --limit-lines $(LIMIT_LINES) --out out/bench

bench-gui: setup build ## The Operator's window: Stop, pictures, processor, memory, start; figures in out/bench/gui.json
	@$(RUN) xvfb-run -a -s "-screen 0 1440x1000x24 -nolisten tcp" env QT_QPA_PLATFORM=xcb \
		python -m mtr_benchmarks.gui --out out/bench

bench-can: setup build ## The Car's bus at full load, learning, replay; figures in out/bench/can.json; CAN_OPTIONS=--short or "--traffic LOGS"
	@$(RUN) OPENBLAS_NUM_THREADS=1 python -m mtr_benchmarks.can_bus --out out/bench $(CAN_OPTIONS)

# Parts: matrix soak fuzz kills link and two more; MATRIX_OPTIONS of the matrix alone: --only PATTERN, --robots, --short, --left.
PROOFS ?=
MATRIX_OPTIONS ?=
bench-faults: setup build ## Matrix, an hour of soak, fuzz, kills and the link's cost, one table; figures in out/bench/faults.json; PROOFS="matrix soak"
	@mkdir -p out/bench
	@$(RUN) python -m mtr_benchmarks.faults.proofs --seed $(SEED) --out out/bench $(if $(PROOFS),--only $(PROOFS))

fault-matrix: setup build ## The matrix of states and faults on the simulated robot; figures in out/bench/matrix/faults.json
	@$(RUN) python -m mtr_benchmarks.faults --seed $(SEED) --out out/bench/matrix $(MATRIX_OPTIONS)

bench-lidar: setup build ## Drives toward a wall and a pole while a LiDAR is covered, dazzled or frozen; figures in out/bench/lidar_course.json
	@$(RUN) python -m mtr_benchmarks.lidar_course --seed $(SEED) --out out/bench

HOURS ?= 8
soak: setup build ## Hours of the robot's time with faults sprinkled in: does anything grow? figures in out/bench/soak.json; HOURS=8
	@$(RUN) python -m mtr_benchmarks.soak --hours $(HOURS) --seed $(SEED) --out out/bench

bench-link: setup build ## What encryption costs a Command on its way to the dispatcher; figures in out/bench/link.json
	@$(RUN) python -m mtr_benchmarks.link --out out/bench

sanitize: setup build ## The C++ tests with sanitizers; SANITIZERS="address thread", PACKAGES="..." for some packages
	@PACKAGES="$(PACKAGES)" setup/sanitize.sh $(SANITIZERS)

red-team: setup build ## Attacks of somebody without a controller's key on the running robot; figures in out/bench/red_team.json
	@$(RUN) python tests/security/report.py --out out/bench

bench-stalls: setup build ## Each node stopped and the clock set while the robot drives; figures in out/bench/liveness.json
	@$(RUN) python -m mtr_benchmarks.liveness --out out/bench

bench-real-time: setup build ## Silences, latencies and load of the robot's nodes on an idle and a busy machine; out/bench/real_time.json
	@$(RUN) python -m mtr_benchmarks.real_time --out out/bench

# Not after setup and build: Gazebo 11 is not for Debian 12. Any shell with a workspace that was built where it is will do;
# make noetic-root NOETIC="declared build gazebo" makes one and runs this in it.
GAZEBO_OPTIONS ?=
gazebo: ## Autolock and Key press on the wall clock in Gazebo and MuJoCo; figures in out/bench/gazebo.json. In a sourced workspace with Gazebo 11
	@command -v gzserver >/dev/null || { echo "gazebo: gzserver is missing; Gazebo 11 is in Debian 11 and for Ubuntu 20.04." >&2; exit 2; }
	@python3 -c 'import mtr_gazebo' 2>/dev/null || { echo "gazebo: source the workspace's devel/setup.bash first." >&2; exit 2; }
	@PYTHONPATH=$$PYTHONPATH:$(CURDIR)/operator_gui/src python3 -m mtr_benchmarks.gazebo --seed $(SEED) --out out/bench $(GAZEBO_OPTIONS)

bench-truth: setup build ## Lines of both scenarios, one disturbance each, against the truth; figures in out/bench/truth.json
	@$(RUN) python -m mtr_benchmarks.truth --seed $(SEED) --out out/bench

bench-kills: setup build ## kill -9 of application and nodes at random instants of each scenario: nothing lost, doubled or changed; KILLS=1000 NODE_KILLS=100
	@$(RUN) python operator_gui/tests/proofs/kills.py --kills $(KILLS) --seed $(SEED) --out out/bench
	@$(RUN) python -m mtr_benchmarks.kills --kills $(NODE_KILLS) --seed $(SEED) --out out/bench

RESULT_TESTS ?= 10000
bench-results: setup build ## The store of results with 10,000 tests of 40 lines: import, list, comparison, page; RESULT_TESTS=10000
	@$(RUN) PYTHONPATH=$$PYTHONPATH:$(CURDIR)/operator_gui/tests/support OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 \
		python operator_gui/tests/proofs/results.py --tests $(RESULT_TESTS) --seed $(SEED) --out out/bench

browser-test: setup build ## The store's pages in Chromium: filter, compare, download, keyboard, narrow screen, print
	@setup/install.sh setup/debian-browser-packages.txt
	@$(RUN) python -m pytest -q operator_gui/tests/browser/pages_in_chromium.py

# Whole stacks take minutes each: bench-campaign measures them for STACKS=2 and more, and compares the cores with them.
CAMPAIGN_RUNS ?= 200
CAMPAIGN_PAIRS ?= 100
CORES ?= 3
STACKS ?= 0
bench-campaign: setup build ## Simulated campaigns: rates of the kernels, workers, a killed one, the demo with itself; CORES=3 STACKS=0
	@$(RUN) PYTHONPATH=$$PYTHONPATH:$(CURDIR)/operator_gui/tests/proofs OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 \
		python operator_gui/tests/proofs/campaigns.py --runs $(CAMPAIGN_RUNS) --pairs $(CAMPAIGN_PAIRS) \
		--cores $(CORES) --stacks $(STACKS) --seed $(SEED) --out out/bench

# Borders and numbers: FUZZ="zeromq bags --cases 100000"; one case again: FUZZ="bags --case 5".
FUZZ ?=
fuzz: setup build ## Spoilt bytes at every border of the project; figures in out/bench/fuzz.json, FUZZ takes borders and options
	@mkdir -p out/bench
	@$(RUN) python tests/fuzz/run.py --seed $(SEED) --out out/bench $(FUZZ) 2> >(grep -v 'libprotobuf ERROR' >&2)

hostile-texts: setup build ## Each text of received documents replaced by each hostile value, then opened, saved, bundled, stored, served
	@$(RUN) MTR_HOSTILE=all QT_QPA_PLATFORM=offscreen python -m pytest -q operator_gui/tests/unit/test_received_texts.py

fuzz-commands: setup build ## 100,000 mutated Commands at the dispatcher's core; figures in out/bench/fuzz_commands.json
	@$(RUN) python catkin_ws/src/mtr_dispatcher/tests/unit/command_fuzz.py --seed $(SEED) --out out/bench

clean: ## Remove everything that was built or written
	rm -rf out firmware/build $(STAMPS) .venv catkin_ws/{build,devel,logs,.catkin_tools} proto/src/mtr_proto/*_pb2.py
