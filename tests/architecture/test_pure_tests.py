"""What outside CI runs on other Pythons, setup/pure_tests.py: chosen without what its job does not have."""
# SPDX-License-Identifier: Apache-2.0
import runpy

from project import TOP, is_standard, package_folders

# Where the name of a distribution is not that of its module.
MODULES = {"pyserial": "serial", "pytest-timeout": "pytest_timeout", "pyyaml": "yaml", "pyzmq": "zmq"}
PURE = runpy.run_path(str(TOP / "setup" / "pure_tests.py"))


def installed_modules():
    """Of the job's list."""
    lines = (TOP / "setup" / "pure-requirements.txt").read_text(encoding="utf-8").splitlines()
    return {MODULES.get(line, line) for line in lines if not line.startswith("#")}


def own_modules(test):
    """The project's packages, and what lies beside a test."""
    sources = {path.name for folder in package_folders() for path in (folder / "src").glob("*") if path.is_dir()}
    return sources | {path.stem for path in test.parent.glob("*.py")}


def test_pure_tests_import_nothing_that_the_job_lacks():
    known = installed_modules()
    missing = {f"{test.name}: {module}" for test in PURE["chosen_tests"]()
               for module in PURE["all_modules_of"](test) - known - own_modules(test) if not is_standard(module)}
    assert not missing


def test_the_list_of_ubuntu_20_04_names_the_same_in_fixed_versions():
    lines = (TOP / "setup" / "focal-requirements.txt").read_text(encoding="utf-8").splitlines()
    pinned = dict(line.split("==") for line in lines if not line.startswith("#"))
    assert {MODULES.get(name, name) for name in pinned} == installed_modules()


def test_pure_tests_are_found():
    names = {test.name for test in PURE["chosen_tests"]()}
    assert {"test_state_machine_table.py", "test_serial_link_frames.py"} <= names
    assert "test_dispatcher_core.py" not in names  # It needs the built mtr_proto.
