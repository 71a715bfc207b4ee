"""Kernels by name; each is imported on first use."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Callable

from ..errors import CampaignError
from ..plan.plan import Plan
from .outcome import Kernel


def _radio() -> Kernel:
    from .radio.kernel import RadioKernel
    return RadioKernel()


def _stack() -> Kernel:
    from .stack import StackKernel
    return StackKernel()


def _cores() -> Kernel:
    from .cores.kernel import CoresKernel
    return CoresKernel()


_KERNELS: dict[str, Callable[[], Kernel]] = {"radio": _radio, "cores": _cores, "stack": _stack}


def kernel_of(name: str) -> Kernel:
    """Return a kernel; CampaignError for an unknown name."""
    if name not in _KERNELS:
        raise CampaignError(f"The kernel is {name!r}; allowed is {', '.join(_KERNELS)}.")
    return _KERNELS[name]()


def check_plan(plan: Plan) -> None:
    """Check that each setting is known and possible at the ends of its range; CampaignError otherwise."""
    from .order import order_of
    kernel = kernel_of(plan.kernel)
    for run in plan.borders():
        kernel.check(order_of(run))
