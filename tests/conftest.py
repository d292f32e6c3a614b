"""For all Python tests."""

import signal

# What is started under nohup or in the background ignores these, and so would every process that a test starts: none of
# them could be ended as a person ends them. A handler of our own is not inherited; the default comes back instead.
for number in (signal.SIGINT, signal.SIGHUP):
    if signal.getsignal(number) is signal.SIG_IGN:
        signal.signal(number, signal.default_int_handler)
