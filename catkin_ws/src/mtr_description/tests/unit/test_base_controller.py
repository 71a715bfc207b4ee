"""Shipped configuration of the base, and invalid files."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_core.errors import ConfigurationError
from mtr_description.base_controller import base_controller_in
from mtr_description.shipped import shipped_base, shipped_base_file


def test_shipped_base_stops_by_itself_and_no_harder_than_the_mast_survives():  # A2
    base = shipped_base()
    assert 0.06 <= base.command_timeout_s <= 0.3
    assert 2.49 <= base.linear_acceleration_mps2 <= 2.71
    assert base.angular_acceleration_radps2 <= 8.0


@pytest.mark.parametrize("right, wrong", [
    ("jackal_velocity_controller:", "another_controller:"), ("max_acceleration: 2.5", "max_acceleration: fast"),
    ("cmd_vel_timeout", "timeout"), ("linear:", "linear: 3\nlinear_of_before:"), ("{}", "]"),
], ids=["other name", "no number", "missing", "no table", "no YAML"])
def test_file_that_does_not_fit_is_a_sentence(tmp_path, right, wrong):
    text = shipped_base_file().read_text(encoding="utf-8")
    path = tmp_path / "base.yaml"
    path.write_text(text.replace(right, wrong) if right in text else text + wrong, encoding="utf-8")
    with pytest.raises(ConfigurationError, match="cannot be used"):
        base_controller_in(path)
