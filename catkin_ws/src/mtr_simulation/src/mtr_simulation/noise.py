"""Random numbers: one stream per source of noise, so that a new sensor does not change the others."""
# SPDX-License-Identifier: Apache-2.0
import zlib

import numpy as np


def stream(seed: int, name: str) -> np.random.Generator:
    """Return the generator of a named source for a seed; PCG64 gives the same numbers on every machine."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed, zlib.crc32(name.encode())])))
