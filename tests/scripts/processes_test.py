"""scripts/lib/processes.sh: what a script starts ends with it, and nothing else does.

The tests wait by reading pipes: a process that ends closes its end.
"""

import os
import signal
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
LIBRARY = ROOT / "scripts/lib/processes.sh"
TIMEOUT_SECONDS = 30  # fails instead of hanging; nothing here should come near it


class Script:
    """A bash script on top of the library. Its children hold the writing end of `alive`."""

    def __init__(self, text: str):
        self._alive, writing = os.pipe()
        os.set_inheritable(writing, True)
        preamble = f"set -euo pipefail\nsay() {{ :; }}\nsource {LIBRARY}\n"
        self.process = subprocess.Popen(
            ["bash", "-c", preamble + text],
            stdout=subprocess.PIPE,
            pass_fds=[writing],
            text=True,
            start_new_session=True,
        )
        os.close(writing)

    def read_line(self) -> str:
        return self.process.stdout.readline().strip()

    def end(self) -> int:
        """The exit status, once the script and everything that it started have ended."""
        status = self.process.wait(timeout=TIMEOUT_SECONDS)
        self.process.stdout.close()
        signal.alarm(TIMEOUT_SECONDS)
        while os.read(self._alive, 1):
            pass
        signal.alarm(0)
        os.close(self._alive)
        return status


STARTS_TWO = """
end_all_at_exit
start bash -c 'echo first; exec sleep 1000'; first=$started
start bash -c 'setsid --fork sleep 1000; echo second; exec sleep 1000'; second=$started
"""


@pytest.mark.parametrize("number, status", [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)])
def test_a_signal_ends_all_that_was_started_even_what_left_its_group(number, status):
    script = Script(STARTS_TWO + 'first_of "$first" "$second"')
    assert {script.read_line(), script.read_line()} == {"first", "second"}
    script.process.send_signal(number)
    assert script.end() == status


def test_the_end_of_one_ends_the_other_and_gives_its_status():
    script = Script('end_all_at_exit\nstart sleep 1000; a=$started\nstart bash -c "exit 7"; b=$started\nfirst_of $a $b')
    assert script.end() == 7


def test_what_ignores_the_polite_signal_is_killed():
    stubborn = """start bash -c 'trap "" INT; echo ready; exec sleep 1000'"""
    script = Script(f"end_all_at_exit\n{stubborn}\nfirst_of $started")
    assert script.read_line() == "ready"
    script.process.send_signal(signal.SIGTERM)
    assert script.end() == 143


def test_a_process_of_someone_else_lives_on():
    other = subprocess.Popen(["sleep", "1000"], env={"PATH": os.environ["PATH"], "URTO_RUN_ID": "1-2"})
    try:
        script = Script(STARTS_TWO + 'first_of "$first" "$second"')
        script.read_line(), script.read_line()
        script.process.send_signal(signal.SIGINT)
        script.end()
        assert other.poll() is None
    finally:
        other.kill()
        other.wait()


def test_a_started_process_does_not_see_a_ctrl_c_at_the_terminal():
    group = "cut -d ' ' -f 5 /proc/$$/stat"
    script = Script(f'{group}\nstart bash -c "{group.replace("$", chr(92) + "$")}"; wait $started')
    assert script.read_line() != script.read_line() != ""
    assert script.end() == 0


def test_waiting_for_a_port_fails_when_the_process_ends():
    script = Script('start false\nwait_for_port "$started" 1 || exit 9')
    assert script.end() == 9
