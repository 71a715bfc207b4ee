"""Executes long work within the requesting tick."""
# SPDX-License-Identifier: Apache-2.0
from concurrent.futures import Executor, Future
from typing import Any, Callable, TypeVar

Value = TypeVar("Value")


class InlineExecutor(Executor):
    """Executes the work before it returns, so that the result does not depend on the machine's speed."""

    def submit(self, fn: Callable[..., Value], *args: Any, **kwargs: Any) -> "Future[Value]":
        """Return the completed work's result."""
        done: Future[Value] = Future()
        try:
            done.set_result(fn(*args, **kwargs))
        except Exception as error:
            done.set_exception(error)
        return done
