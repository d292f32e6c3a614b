"""Every scene of tests/scenes/ is one that urtod takes."""

import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
URTOD = ROOT / "build/release/bin/urtod"


def check(scene):
    command = [URTOD, "--check", "--scene", scene]
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)


@pytest.mark.parametrize("path", sorted((ROOT / "tests/scenes").glob("*.txtpb")), ids=lambda path: path.stem)
def test_urtod_accepts_the_scene(path):
    result = check(path)
    assert result.returncode == 0, result.stderr


def test_urtod_refuses_what_is_not_a_scene(tmp_path):
    file = tmp_path / "broken.txtpb"
    file.write_text('name: "broken"\nbodies { position { x: 0 y: z } }\n', encoding="utf-8")
    result = check(file)
    assert result.returncode != 0
    assert "broken.txtpb" in result.stderr
