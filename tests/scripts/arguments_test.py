"""The scripts' options: help, lists, and clear errors before anything is installed or started."""

import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def script(name, *arguments):
    return subprocess.run([ROOT / "scripts" / name, *arguments], capture_output=True, text=True, check=False, cwd="/")


@pytest.mark.parametrize("name", ["run", "test"])
def test_help_goes_to_standard_output(name):
    result = script(name, "--help")
    assert result.returncode == 0
    assert result.stdout.startswith(f"usage: scripts/{name}")
    assert result.stderr == ""


def test_list_names_every_scene_with_its_description():
    result = script("run", "--list")
    named = {line.split()[0] for line in result.stdout.splitlines()}
    assert named == {path.stem for path in (ROOT / "tests/scenes").glob("*.txtpb")}
    assert all(len(line.split()) > 4 for line in result.stdout.splitlines())


@pytest.mark.parametrize(
    "name, arguments, words",
    [
        ("run", ["--scene", "nowhere"], ["nowhere", "pyramid", "tumbler"]),
        ("run", ["--scene"], ["--scene needs a value"]),
        ("run", ["--seconds", "soon"], ["--seconds", "soon"]),
        ("run", ["--listen", "7447"], ["--listen", "7447"]),
        ("run", ["--sceen", "pile"], ["--sceen", "--help"]),
        ("test", ["--only", "nothing"], ["nothing", "--help"]),
        ("test", ["--fast"], ["--fast", "--help"]),
    ],
)
def test_a_wrong_argument_is_named(name, arguments, words):
    result = script(name, *arguments)
    assert result.returncode == 1
    assert result.stdout == ""
    assert all(word in result.stderr for word in words), result.stderr


def test_the_cases_of_a_report_are_counted(tmp_path):
    report = tmp_path / "report.xml"
    report.write_text(
        '<testsuites><testsuite><testcase name="a"/><testcase name="b"><failure/></testcase>'
        '<testcase name="c"><error/></testcase><testcase name="d"><skipped/></testcase>'
        '<testcase name="e" status="notrun"/></testsuite></testsuites>'
    )
    command = ["python3", ROOT / "scripts/lib/count_cases.py", report]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == "1 2 2\n"
