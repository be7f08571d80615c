"""What every test needs of the process that it runs in."""

import signal

# A shell hands an ignored SIGINT down to what it runs in the background; tests send interrupts.
if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
