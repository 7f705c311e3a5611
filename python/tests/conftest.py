"""What all these tests need."""

import signal

# A shell's job in the background ignores the interrupt that some of them send.
signal.signal(signal.SIGINT, signal.default_int_handler)
