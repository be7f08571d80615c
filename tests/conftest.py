"""What every test needs of the process that it runs in, and its random numbers."""

import signal

import numpy as np
import pytest

# A shell hands an ignored SIGINT down to what it runs in the background; tests send interrupts.
if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture
def rng() -> np.random.Generator:
    """The same numbers in each test, whichever ran before."""
    return np.random.default_rng(29)
