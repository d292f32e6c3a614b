"""The package as a whole: its names, its errors, its generated modules."""

from __future__ import annotations

import inspect
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import urto
from urto import _exceptions

ROOT = Path(__file__).resolve().parents[3]


def test_all_names_what_is_there_and_nothing_else() -> None:
    assert len(set(urto.__all__)) == len(urto.__all__)
    public = {name for name in vars(urto) if not name.startswith("_") and name != "annotations"}
    assert public == set(urto.__all__)


def test_the_drawn_exception_tree_is_the_real_one() -> None:
    tree = inspect.getdoc(_exceptions) or ""
    drawn = [line.split("──")[-1].split()[0] for line in tree.splitlines() if "── " in line]
    real = {
        name for name, kind in vars(_exceptions).items() if inspect.isclass(kind) and issubclass(kind, urto.UrtoError)
    }
    assert set(drawn) | {"UrtoError"} == real
    assert real <= set(urto.__all__)


def test_every_rejection_of_the_schema_has_its_exception() -> None:
    from urto._proto.v1 import command_pb2

    codes = {name.removeprefix("REJECTION_CODE_") for name in command_pb2.RejectionCode.keys()} - {"UNSPECIFIED"}
    assert codes == set(_exceptions._REJECTIONS)
    rejection = command_pb2.Rejection(code=99, message="new")  # type: ignore[arg-type]
    unknown = command_pb2.CommandReply(rejection=rejection)
    error = _exceptions.rejection_from_proto(unknown)
    assert (type(error), error.code) == (urto.Rejected, "99")


def test_public_functions_are_documented() -> None:
    for owner in (urto.Room, urto.BodyHandle, urto.Batch, urto.Frame, urto.aio.Room, urto.aio.BodyHandle):
        for name, member in inspect.getmembers(owner):
            if not name.startswith("_") and (inspect.isfunction(member) or isinstance(member, property)):
                assert inspect.getdoc(member), f"{owner.__name__}.{name}"


def test_generated_modules_are_up_to_date() -> None:
    if shutil.which("protoc") is None:
        pytest.skip("no protoc here")
    version = subprocess.run(["protoc", "--version"], capture_output=True, text=True, check=True).stdout
    if " 3.21." not in version:
        pytest.skip(f"made with protoc 3.21, here is {version.strip()}")
    done = subprocess.run(
        [sys.executable, ROOT / "scripts" / "generate-proto", "--check"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


def test_the_readme_shows_the_first_script_as_it_is() -> None:
    script = (ROOT / "examples" / "first_script.py").read_text(encoding="utf-8").split('"""', 2)[2].strip()
    assert script in (ROOT / "README.md").read_text(encoding="utf-8")
