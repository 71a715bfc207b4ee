"""Array types for annotations; the robot's numpy (1.17) lacks numpy.typing."""
# SPDX-License-Identifier: Apache-2.0
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    FloatArray = NDArray[np.float64]
    IntArray = NDArray[np.int64]
    BoolArray = NDArray[np.bool_]
else:
    FloatArray = IntArray = BoolArray = np.ndarray
