"""Releases of an installed robot: one is in use, the one before it can be gone back to, whatever fails."""
# SPDX-License-Identifier: Apache-2.0
import ipaddress
import os
import pathlib
import re
import shutil
import subprocess

import pytest

from mtr_commissioning.standstill.judge import Verdict

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "setup" / "install-robot.sh"
# What stands in for catkin "builds" in two steps, as catkin does package by package; a build `broken` fails between.
CATKIN = """#!/bin/sh
if [ "$1" = config ]; then
  while [ "$1" != --install-space ]; do shift; done
  echo "$2" >space
else
  mkdir -p "$(cat space)/lib"
  echo "export BUILT=$BUILD" >"$(cat space)/setup.bash"
  [ "$BUILD" != broken ] || exit 1
  echo whole >"$(cat space)/lib/library"
fi
"""
PROGRAMS = {"catkin": CATKIN, "git": "#!/bin/sh\necho 0.2.0-7-gabcdef0\n", "roslaunch": '#!/bin/sh\necho "$BUILT"\n'}
# Ends the script before its step number $LAST that changes something, as a power cut does: nothing is tidied up.
POWER_CUT = """
before_each() {
  [[ $1 =~ ^(catkin|echo|install|ln|mkdir|mv|rm|sync)\\  ]] || return 0
  echo "$1" >>"$STEPS"
  (($(wc -l <"$STEPS") != LAST)) || kill -KILL $$ "$BASHPID"
}
trap 'before_each "$BASH_COMMAND"' DEBUG
set -o functrace
"""


class Robot:
    """A robot's disk below a folder.

    Attributes:
        disk: folder that is the robot's /.
        prefix: /opt/mtr of the robot.
    """

    def __init__(self, folder):
        self._folder = folder
        self.disk = folder / "disk"
        self.prefix = self.disk / "opt" / "mtr"
        self.prefix.mkdir(parents=True)
        (folder / "ros").mkdir()
        (folder / "ros" / "setup.bash").touch()
        (folder / "power_cut.bash").write_text(POWER_CUT, encoding="ascii")
        (folder / "programs").mkdir()
        for name, text in PROGRAMS.items():
            program = folder / "programs" / name
            program.write_text(text, encoding="ascii")
            program.chmod(0o755)

    def run(self, *words, build="", **environment):
        """The finished script."""
        path = f"{self._folder / 'programs'}:{os.environ['PATH']}"
        where = ["--staging", str(self.disk), "--ros", str(self._folder / "ros")]
        return subprocess.run([SCRIPT, *words, *where], check=False, capture_output=True, text=True,
                              env=dict(os.environ, PATH=path, BUILD=build, **environment))

    def install(self, build):
        done = self.run(build=build)
        assert done.returncode == 0, done.stderr

    def rollback(self):
        done = self.run("rollback")
        assert done.returncode == 0, done.stderr

    def cut_off(self, step, *words, build=""):
        """The power goes before a step of the script. True if it had that many."""
        steps = self._folder / "steps"
        steps.unlink(missing_ok=True)
        done = self.run(*words, build=build, BASH_ENV=str(self._folder / "power_cut.bash"), STEPS=str(steps),
                        LAST=str(step))
        assert done.returncode in (0, -9), done.stderr
        return done.returncode == -9

    def started(self):
        """The build that the robot's service starts, which has to be whole."""
        assert (self.prefix / "current" / "lib" / "library").is_file()
        done = subprocess.run([self.prefix / "start"], check=True, capture_output=True, text=True,
                              env={"PATH": f"{self._folder / 'programs'}:/usr/bin:/bin", "HOME": "/nowhere"})
        return done.stdout.strip()

    def releases(self):
        """How many releases lie on the disk."""
        return len([path for path in self.prefix.iterdir() if path.is_dir() and not path.is_symlink()])


@pytest.fixture
def robot(tmp_path):
    return Robot(tmp_path)


@pytest.fixture(scope="module", name="disk_of_upgraded")
def make_disk_of_upgraded(tmp_path_factory):
    """The disk of a robot that was installed and upgraded: `second` is in use."""
    robot = Robot(tmp_path_factory.mktemp("robot"))
    robot.install("first")
    robot.install("second")
    return robot.disk


@pytest.fixture
def upgraded(robot, disk_of_upgraded):
    """A robot of its own with that disk."""
    shutil.copytree(disk_of_upgraded, robot.disk, symlinks=True, dirs_exist_ok=True)
    return robot


def test_an_installation_is_in_use_and_says_of_which_commit_it_is(robot):
    robot.install("first")
    assert robot.started() == "first"
    assert (robot.prefix / "current" / "release").read_text(encoding="ascii") == "0.2.0-7-gabcdef0\n"


def test_after_upgrades_two_releases_are_kept(upgraded):
    upgraded.install("third")
    assert upgraded.started() == "third" and upgraded.releases() == 2


def test_rollback_goes_back_and_a_second_one_forth_again(upgraded):
    upgraded.rollback()
    assert upgraded.started() == "first"
    upgraded.rollback()
    assert upgraded.started() == "second"


def test_an_upgrade_after_a_rollback_keeps_what_was_in_use(upgraded):
    upgraded.rollback()
    upgraded.install("third")
    assert upgraded.started() == "third"
    upgraded.rollback()
    assert upgraded.started() == "first"


def test_a_failed_build_leaves_both_releases_and_nothing_of_its_own(upgraded):
    assert upgraded.run(build="broken").returncode != 0
    assert upgraded.started() == "second" and upgraded.releases() == 2
    upgraded.rollback()
    assert upgraded.started() == "first"


def test_without_a_former_release_rollback_says_so_and_changes_nothing(robot):
    robot.install("first")
    assert robot.run(build="broken").returncode != 0
    done = robot.run("rollback")
    assert done.returncode == 2 and "no former release" in done.stderr and robot.started() == "first"


def test_rollback_takes_no_release_that_is_not_whole(upgraded):
    (upgraded.prefix / "current" / "former" / "release").unlink()
    assert upgraded.run("rollback").returncode == 2 and upgraded.started() == "second"


# Steps of an upgrade and of a rollback that change something, and one more that they have not.
UPGRADE_STEPS, ROLLBACK_STEPS = 43, 9


@pytest.mark.parametrize("step", range(1, UPGRADE_STEPS + 1))
def test_a_power_cut_in_an_upgrade_leaves_a_robot_that_starts_and_can_be_upgraded(upgraded, step):
    assert upgraded.cut_off(step, build="third") is (step < UPGRADE_STEPS)
    before = upgraded.started()
    assert before in ("second", "third")
    upgraded.install("fourth")
    assert upgraded.started() == "fourth" and upgraded.releases() == 2
    upgraded.rollback()
    assert upgraded.started() == before


@pytest.mark.parametrize("step", range(1, ROLLBACK_STEPS + 1))
def test_a_power_cut_in_a_rollback_leaves_a_robot_that_starts_and_rolls_back(upgraded, step):
    assert upgraded.cut_off(step, "rollback") is (step < ROLLBACK_STEPS)
    before = upgraded.started()
    upgraded.rollback()
    assert {before, upgraded.started()} == {"first", "second"}


@pytest.fixture
def lettered(robot):
    """A robot whose releases are called a and b, as the script once did it: b, `second`, is in use."""
    for letter, build in (("a", "first"), ("b", "second")):
        (robot.prefix / letter / "lib").mkdir(parents=True)
        (robot.prefix / letter / "lib" / "library").touch()
        (robot.prefix / letter / "setup.bash").write_text(f"export BUILT={build}\n", encoding="ascii")
        (robot.prefix / letter / "release").write_text(f"{build}\n", encoding="ascii")
    (robot.prefix / "current").symlink_to("b")
    shutil.copy(SCRIPT.parent / "robot" / "start", robot.prefix)
    return robot


def test_former_installation_rolls_back(lettered):
    lettered.rollback()
    assert lettered.started() == "first"


def test_former_installation_is_upgraded_and_keeps_what_was_in_use(lettered):
    lettered.install("third")
    assert lettered.started() == "third" and lettered.releases() == 2
    lettered.rollback()
    assert lettered.started() == "second"


def test_former_installation_keeps_both_releases_when_its_upgrade_fails(lettered):
    assert lettered.run(build="broken").returncode != 0
    assert lettered.started() == "second"
    lettered.rollback()
    assert lettered.started() == "first"


def test_former_installation_with_half_a_release_does_not_roll_back_to_it(lettered):
    (lettered.prefix / "a" / "release").unlink()
    assert lettered.run("rollback").returncode == 2 and lettered.started() == "second"


def test_the_clock_is_a_source_without_internet_for_the_laptops_of_the_access_point(robot):
    robot.install("first")
    lines = (robot.disk / "etc" / "chrony" / "conf.d" / "mtr-robot.conf").read_text(encoding="ascii").splitlines()
    assert "local stratum 10" in lines
    allowed = [ipaddress.ip_network(line.split()[1]) for line in lines if line.startswith("allow ")]
    access_point = re.findall(r"\b(\d+\.\d+\.\d+\.\d+/\d+)\b", SCRIPT.read_text(encoding="utf-8"))
    assert allowed == [ipaddress.ip_interface(address).network for address in access_point]


@pytest.mark.parametrize("settings, is_told", [
    # As Ubuntu 20.04 ships it (chrony 3.5), and as Debian 12 does (4.3).
    ("pool ntp.ubuntu.com iburst maxsources 4\n", True), ("confdir /etc/chrony/conf.d\nmakestep 1 3\n", False)])
def test_chrony_is_told_once_where_its_further_settings_are(robot, settings, is_told):
    path = robot.disk / "etc" / "chrony" / "chrony.conf"
    path.parent.mkdir(parents=True)
    path.write_text(settings, encoding="ascii")
    robot.install("first")
    robot.install("second")
    text = path.read_text(encoding="ascii")
    assert text.startswith(settings) and text.count("include /etc/chrony/conf.d/*.conf") == is_told


def test_jackal_is_started_with_its_base_and_keeps_the_persons_other_settings(robot):
    assert "Install the software first" in robot.run("jackal").stderr
    robot.install("first")
    settings = robot.disk / "etc" / "mtr" / "robot.env"
    before = settings.read_text(encoding="utf-8").replace("bind_address:=127.0.0.1", "bind_address:=10.42.0.1")
    # As an installation of before has it, which knew no master of others.
    settings.write_text(before.replace("MTR_MASTER=own\n", ""), encoding="utf-8")
    assert robot.run("jackal").returncode == 0
    lines = settings.read_text(encoding="utf-8").splitlines()
    assert {"MTR_LAUNCH=jackal.launch", "MTR_MASTER=wait", 'MTR_ARGUMENTS="bind_address:=10.42.0.1"'} <= set(lines)
    assert len([line for line in lines if line.startswith("MTR_")]) == 4
    for unit in ("mtr-robot.service", "mtr-base.service"):
        assert (robot.disk / "etc/systemd/system" / f"{unit}.d" / "mtr-service.conf").is_file()
        assert (robot.disk / "etc/systemd/system" / unit).is_file()
    assert (robot.disk / "etc/systemd/system/mtr.slice").is_file()
    again = settings.read_text(encoding="utf-8")
    assert robot.run("jackal").returncode == 0 and settings.read_text(encoding="utf-8") == again


STANDSTILL_FUNCTIONS = ("fail", "in_use", "standstill", "require_standstill", "use")


class RunningRobot:
    """Two releases and a service that runs; the release in use answers as it is told to."""

    def __init__(self, folder):
        self._folder = folder
        self._programs = folder / "programs"
        self._programs.mkdir()
        for number in (1, 2):
            release = folder / f"release-{number}"
            release.mkdir()
            (release / "release").write_text(f"{number}\n", encoding="ascii")
            (release / "setup.bash").touch()
        self._current = folder / "current"
        self._current.symlink_to("release-1")
        self.service("true")

    def service(self, is_active):
        self._write(self._programs / "systemctl", f'[ "$*" = "is-active --quiet mtr-robot" ] && {is_active}')

    def answers(self, status, sentence="Says so.", package="mtr_commissioning"):
        program = self._folder / "release-1" / "lib" / package / "standstill"
        program.parent.mkdir(parents=True)
        self._write(program, f'echo "A warning." >&2\necho "{sentence}"\nexit {status}')

    def use(self, force=""):
        """Error output of the function `use` for the second release, and the release that is in use afterwards."""
        text = SCRIPT.read_text(encoding="utf-8")
        functions = [re.search(rf"^{name}\(\) [{{(]$.*?^[}})]$", text, re.DOTALL | re.MULTILINE)[0]
                     for name in STANDSTILL_FUNCTIONS]
        program = "\n".join([f"set -euo pipefail; staging= force={force} prefix={self._folder}", *functions,
                             "use release-2"])
        done = subprocess.run(["bash", "-c", program], check=False, capture_output=True, text=True,
                              env={"PATH": f"{self._programs}:/usr/bin:/bin"})
        assert (done.returncode == 0) is (os.readlink(self._current) == "release-2")
        return done.stderr, os.readlink(self._current)

    @staticmethod
    def _write(program, text):
        program.write_text(f"#!/bin/sh\n{text}\n", encoding="ascii")
        program.chmod(0o755)


@pytest.fixture
def running(tmp_path):
    return RunningRobot(tmp_path)


@pytest.mark.parametrize("package", ["mtr_commissioning", "mtr_bringup"], ids=["release", "older release"])
@pytest.mark.parametrize("force", ["", "yes"])
def test_release_of_a_robot_that_moves_or_is_not_stopped_is_replaced_not_even_by_force(running, force, package):
    running.answers(Verdict.REFUSED.value, "No stop is engaged.", package)
    said, in_use = running.use(force)
    assert in_use == "release-1" and said.strip() == "install-robot: No stop is engaged. The release in use stays."


def test_release_of_a_robot_that_stands_with_a_stop_engaged_is_replaced(running):
    running.answers(Verdict.MAY_STOP.value)
    assert running.use() == ("", "release-2")


@pytest.mark.parametrize("status", [Verdict.SILENT.value, 1, 2, 124, None], ids=[
    "says so", "defect", "wrong options", "timeout", "release without the check"])
def test_release_that_does_not_answer_is_replaced_by_force_only(running, status):
    if status is not None:
        running.answers(status)
    said, in_use = running.use()
    assert in_use == "release-1" and len(said.splitlines()) == 1 and said.strip().endswith("repeat this with --force.")
    assert running.use("yes") == ("", "release-2")


def test_release_of_a_robot_whose_service_does_not_run_is_replaced(running):
    running.service("false")
    running.answers(Verdict.REFUSED.value)
    assert running.use() == ("", "release-2")


@pytest.mark.parametrize("action", ["install", "rollback", "jackal"])
def test_each_action_that_restarts_the_robot_requires_standstill_before_anything_changes(action):
    text = SCRIPT.read_text(encoding="utf-8")
    body = re.search(rf"^  {action}\)$(.*?)^    ;;$", text, re.DOTALL | re.MULTILINE)[1]
    required = body.index("require_standstill") if "require_standstill" in body else body.index("    use ")
    changes = [body.index(word) for word in ("remove_unused", "build ", "base_by_us", "install_files", "restart")
               if word in body]
    assert changes and required < min(changes)


def called_by(function, folder):
    """What a function of the script runs on a robot, where it is no try below a folder: words of each call."""
    calls = folder / "calls"
    for name in ("apt-get", "rosdep", "systemctl"):
        program = folder / name
        program.write_text(f'#!/bin/sh\necho "{name}" "$@" >>"{calls}"\n', encoding="ascii")
        program.chmod(0o755)
    text = re.search(rf"^{function}\(\) {{$.*?^}}$", SCRIPT.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    program = f"set -euo pipefail; staging= top=/top packages=(a b)\n{text[0]}\n{function}"
    subprocess.run(["bash", "-c", program], check=True, env={"PATH": f"{folder}:/usr/bin:/bin"})
    return [line.split() for line in calls.read_text(encoding="ascii").splitlines()]


def test_rosdep_is_asked_for_each_kind_of_dependency_by_an_option_of_its_own(tmp_path):
    # It takes one word of these with each option, and refuses another.
    words = next(words for words in called_by("install_packages", tmp_path) if words[:2] == ["rosdep", "install"])
    assert "--dependency-types" not in words and "test" not in words
    told = [kind for option, kind in zip(words, words[1:]) if option == "-t"]
    assert sorted(told) == ["build", "build_export", "buildtool", "buildtool_export", "exec"]


def test_base_that_runs_is_started_anew_with_the_release_before_the_robot(tmp_path):
    assert called_by("restart", tmp_path) == [["systemctl", "try-restart", "mtr-base"],
                                              ["systemctl", "restart", "mtr-robot"]]
