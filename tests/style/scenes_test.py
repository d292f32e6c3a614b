"""The scene files: what the generator writes, valid, and named in the documentation."""

import importlib.util
import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SCENES = sorted((ROOT / "tests/scenes").glob("*.txtpb"))


def load_generator():
    spec = importlib.util.spec_from_file_location("generate", ROOT / "tests/scenes/generate.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


generate = load_generator()


@pytest.mark.parametrize("name", sorted(generate.generate()))
def test_a_committed_scene_is_what_the_generator_writes(name):
    committed = (ROOT / "tests/scenes" / name).read_text(encoding="utf-8")
    assert committed == generate.generate()[name], f"{name} differs: run tests/scenes/generate.py"


def test_check_reports_a_changed_and_a_missing_file(tmp_path, capsys):
    assert generate.main([str(tmp_path)]) == 0
    assert generate.main(["--check", str(tmp_path)]) == 0
    (tmp_path / "arch.txtpb").write_text("name: 'other'\n", encoding="utf-8")
    (tmp_path / "orbit.txtpb").unlink()
    capsys.readouterr()
    assert generate.main(["--check", str(tmp_path)]) == 1
    assert sorted(capsys.readouterr().out.splitlines()) == ["differs: arch.txtpb", "differs: orbit.txtpb"]
    assert not (tmp_path / "orbit.txtpb").exists()


def test_numbers_are_written_short_and_without_a_negative_zero():
    assert [generate.number(value) for value in (1.0, -1e-7, 0.5, 12.3456789)] == ["1", "0", "0.5", "12.345679"]


@pytest.mark.skipif(shutil.which("protoc") is None, reason="protoc is not installed")
@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_a_scene_parses_as_the_schema(path):
    command = ["protoc", "--encode=urto.v1.Scene", "-Iproto", "urto/v1/scene.proto"]
    result = subprocess.run(command, cwd=ROOT, input=path.read_bytes(), capture_output=True, check=False)
    assert result.returncode == 0, result.stderr.decode()
    assert result.stdout


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_a_scene_names_itself_describes_itself_and_has_a_view(path):
    text = path.read_text(encoding="utf-8")
    assert re.search(rf'^name: "{re.escape(path.stem)}"$', text, re.MULTILINE)
    assert re.search(r'^description: ".{20,}"$', text, re.MULTILINE)
    assert re.search(r"^view \{", text, re.MULTILINE)


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_the_names_of_the_bodies_differ(path):
    names = re.findall(r'^  name: "(.*)"$', path.read_text(encoding="utf-8"), re.MULTILINE)
    assert len(names) == len(set(names)), [name for name in names if names.count(name) > 1]


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_the_documentation_lists_the_scene(path):
    documents = [*(ROOT / "docs").glob("*.md"), ROOT / "README.md"]
    assert any(f"`{path.stem}`" in document.read_text(encoding="utf-8") for document in documents), path.stem
