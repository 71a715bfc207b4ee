"""Parameters of the state machine."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import asdict, dataclass
from typing import Any, Dict

from mtr_core.errors import ConfigurationError, check_range


@dataclass(frozen=True)
class Parameters:
    """What the state machine is started with.

    Attributes:
        silent_after_s: age of a part's newest message at which the part has failed, 0.2 to 5 s.
    """

    silent_after_s: float = 0.5

    def __post_init__(self) -> None:
        check_range("silent_after_s", self.silent_after_s, 0.2, 5.0, "s")


def parameters_from(values: Dict[str, Any]) -> Parameters:
    """From the values of a parameter server; unknown names and wrong types are refused."""
    defaults = asdict(Parameters())
    for name, value in values.items():
        if name not in defaults:
            raise ConfigurationError(f"Parameter {name} is unknown; allowed are {', '.join(sorted(defaults))}.")
        default = defaults[name]
        kind = (int, float) if isinstance(default, float) else type(default)
        if not isinstance(value, kind) or isinstance(value, bool) is not isinstance(default, bool):
            raise ConfigurationError(f"Parameter {name} is {value!r}; allowed is a value like {default!r}.")
    return Parameters(**values)
