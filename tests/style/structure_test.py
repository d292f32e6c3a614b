"""The shape of the tree: who may include whom, how long a file is, what no file may hold.

Each rule is a function from a file's text to what is wrong with it, so that a test can show that it finds a fault.
"""

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
LINES_MAX = 800
COLUMNS_MAX = 120

# What a part of the server may include besides itself, the standard library and third parties.
ALLOWED = {
    "physics": set(),
    "room": {"physics"},
    "codec": {"room", "physics", "urto"},  # urto/v1/*.pb.h: the generated schema
    "transport": set(),
    "app": {"codec", "transport", "room", "physics", "urto"},
}
# What a part may use from outside: the prefix of the include, and the only parts that may have it.
THIRD_PARTIES = {
    "google/protobuf": {"codec", "app"},
    "urto_zenoh": {"transport"},
    "rust/": {"transport"},
    "CLI/": {"app"},
    "spdlog/": {"app"},
}


# Headers of others, by their beginning, and the Debian package that brings them: scripts/lib/setup.sh installs it.
PACKAGES = {
    "Eigen/": "libeigen3-dev",
    "tl/expected": "libexpected-dev",
    "xxhash.h": "libxxhash-dev",
    "hwy/": "libhwy-dev",
    "google/protobuf/": "libprotobuf-dev",
    "spdlog/": "libspdlog-dev",
    "CLI/": "libcli11-dev",
    "gtest/": "libgtest-dev",
    "gmock/": "libgmock-dev",
}

# Where a foreign program is waited for that tells nobody when it listens.
MAY_POLL = {f"clients/python/src/urto/_viewer/{each}.py" for each in ("outputs", "screenshot")}


def tracked_files() -> list[Path]:
    """The files of the project: those that git knows and those that it would not ignore."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard"]
    try:
        listing = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
        paths = [ROOT / line for line in listing.splitlines()]
    except (FileNotFoundError, subprocess.CalledProcessError):  # no git, or not a checkout
        left_out = {"build", ".venv", "out", "target", "__pycache__", ".git"}
        paths = [path for path in ROOT.rglob("*") if not left_out & set(path.relative_to(ROOT).parts)]
    return sorted(path for path in paths if path.is_file())


FILES = tracked_files()
TEXT_SUFFIXES = {".h", ".cpp", ".rs", ".py", ".proto", ".md", ".cmake", ".txt", ".toml", ".yaml", ".json", ".sh", ""}
TEXTS = [path for path in FILES if path.suffix in TEXT_SUFFIXES and path.name != "Cargo.lock"]
WRITTEN_BY_TOOLS = re.compile(r"_pb2\.pyi?$|\.lock$|\.txtpb$|golden\.txt$")


def of_kind(*suffixes: str) -> list[Path]:
    return [path for path in FILES if path.suffix in suffixes and not WRITTEN_BY_TOOLS.search(path.name)]


def name(path: Path) -> str:
    return str(path.relative_to(ROOT))


def includes(text: str) -> list[str]:
    return re.findall(r'^\s*#\s*include\s*["<]([^">]+)[">]', text, re.MULTILINE)


def wrong_includes(part: str, text: str) -> list[str]:
    wrong = []
    for include in includes(text):
        top = include.split("/")[0]
        if "/" in include and top in {*ALLOWED, "urto"} and top != part and top not in ALLOWED[part]:
            wrong.append(include)
        wrong += [
            include for prefix, parts in THIRD_PARTIES.items() if include.startswith(prefix) and part not in parts
        ]
    return wrong


def waits_by_the_clock(text: str) -> list[str]:
    return re.findall(
        r"\b(?:time\.sleep|sleep_for|sleep_until|usleep|nanosleep|asyncio\.sleep)\s*\((?!\s*0\s*\))", text
    )


def machine_paths(text: str) -> list[str]:
    return re.findall(r"(?<![\w.$}/-])/(?:work|root|home|tmp)/[\w.-]+|\.\./shared", text)


def unfinished_marks(text: str) -> list[str]:
    return re.findall(r"\b(?:TODO|FIXME|XXX|HACK)\b", text)


def borrowed_headers(text: str) -> list[str]:
    """Algorithms of a file that has `<algorithm>` only by way of other headers: another library brings fewer."""
    if "<algorithm>" in text:
        return []
    return re.findall(
        r"std::(?:max|min|minmax|clamp|sort|stable_sort|nth_element|fill|copy|find|find_if|count_if|all_of|any_of"
        r"|none_of|max_element|min_element|lower_bound|upper_bound|equal|reverse|rotate|unique|transform|remove_if)\(",
        text,
    )


def undocumented(proto: str) -> list[str]:
    """Numbers whose unit stands neither beside them, nor on the two lines above, nor in the comment of their message;
    messages and enums without a comment whose fields have none either."""
    wrong = []
    above: list[str] = []
    heading = message = ""
    silent: dict[str, bool] = {}
    for line in proto.splitlines():
        opening = re.match(r"\s*(?:message|enum) (\w+) \{", line)
        if opening:
            message = opening.group(1)
            heading = above[-1] if above and above[-1].lstrip().startswith("//") else ""
            silent[message] = not heading and "//" not in line
        elif "//" in line and message:
            silent[message] = False
        if re.match(r"\s+(?:optional |repeated )?(?:double|float) \w+ = \d+", line):
            near = [line, *above[-2:]]
            if not heading and not any("//" in each for each in near):
                wrong.append(line.strip())
        above.append(line)
    return wrong + [each for each, is_silent in silent.items() if is_silent and f"message {each} {{}}" not in proto]


@pytest.mark.parametrize("path", [path for path in of_kind(".h", ".cpp") if name(path).startswith("server/")], ids=name)
def test_a_part_includes_only_what_lies_below_it(path):
    part = name(path).split("/")[1]
    assert wrong_includes(part, path.read_text(encoding="utf-8")) == []


@pytest.mark.parametrize("prefix, package", PACKAGES.items())
def test_the_setup_installs_what_is_included(prefix, package):
    sources = [
        path.read_text(encoding="utf-8") for path in of_kind(".h", ".cpp") if not name(path).startswith("bench/")
    ]
    included = any(include.startswith(prefix) for text in sources for include in includes(text))
    installed = re.search(rf"[( ]{package}[) \n]", (ROOT / "scripts/lib/setup.sh").read_text(encoding="utf-8"))
    assert included == bool(installed)


@pytest.mark.parametrize("path", [path for path in of_kind(".h", ".cpp") if name(path).startswith("server/")], ids=name)
def test_a_foreign_header_has_its_package_named(path):
    foreign = re.findall(r"^\s*#\s*include\s*<([^>]*[./][^>]*)>", path.read_text(encoding="utf-8"), re.MULTILINE)
    compilers = ("emmintrin.h", "immintrin.h", "arm_neon.h", "pthread.h", "unistd.h", "sys/")
    assert [each for each in foreign if not each.startswith((*PACKAGES, *compilers))] == []


@pytest.mark.parametrize("path", of_kind(".h", ".cpp", ".rs", ".py", ".proto", ".sh", ".cmake"), ids=name)
def test_a_source_file_is_short_enough_to_read(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    assert len(lines) <= LINES_MAX
    if path.suffix not in (".sh", ".cmake", ".rs"):
        columns = [len(re.sub(r"  # (?:type|fmt|noqa).*", "", line)) for line in lines]
        assert [number for number, width in enumerate(columns, 1) if width > COLUMNS_MAX] == []


@pytest.mark.parametrize(
    "path", [path for path in of_kind(".cpp", ".h", ".py") if name(path).startswith(("tests/", "clients/"))], ids=name
)
def test_tests_and_clients_wait_on_events(path):
    if path != Path(__file__) and name(path) not in MAY_POLL:
        assert waits_by_the_clock(path.read_text(encoding="utf-8")) == []


@pytest.mark.parametrize("path", TEXTS, ids=name)
def test_a_file_names_no_path_of_one_machine_and_nothing_unfinished(path):
    text = path.read_text(encoding="utf-8")
    if path != Path(__file__):
        assert machine_paths(text) + unfinished_marks(text) == []


@pytest.mark.parametrize("path", of_kind(".h", ".cpp"), ids=name)
def test_a_source_includes_the_algorithms_that_it_uses(path):
    assert borrowed_headers(path.read_text(encoding="utf-8")) == []


@pytest.mark.parametrize("path", of_kind(".proto"), ids=name)
def test_the_schema_is_documented(path):
    assert undocumented(path.read_text(encoding="utf-8")) == []


@pytest.mark.parametrize("path", [path for path in of_kind(".h") if name(path).startswith("server/")], ids=name)
def test_a_header_is_guarded(path):
    if path.name.endswith("-inl.h"):  # meant to be read once for each instruction set, by Highway's own guard
        assert "HWY_TARGET_TOGGLE" in path.read_text(encoding="utf-8")
        return
    assert "#pragma once" in path.read_text(encoding="utf-8").splitlines()[:5]


@pytest.mark.parametrize("script", ["scripts/run", "scripts/test"])
def test_the_readme_tells_of_the_scripts(script):
    assert script in (ROOT / "README.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("path", of_kind(".md"), ids=name)
def test_a_link_of_the_documentation_leads_somewhere(path):
    text = re.sub(r"```.*?```", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
    targets = [target.split("#")[0] for target in re.findall(r"\]\(([^)\s]+)\)", text)]
    local = [target for target in targets if target and "://" not in target and not target.startswith("mailto:")]
    assert [target for target in local if not (path.parent / target).exists()] == []


@pytest.mark.parametrize(
    "rule, fault",
    [
        (lambda text: wrong_includes("physics", text), '#include "room/room.h"'),
        (lambda text: wrong_includes("room", text), '#include "codec/scene_codec.h"'),
        (lambda text: wrong_includes("room", text), "#include <google/protobuf/message.h>"),
        (lambda text: wrong_includes("transport", text), '#include "physics/world.h"'),
        (lambda text: wrong_includes("codec", text), '#include "transport/transport.h"'),
        (waits_by_the_clock, "  time.sleep(0.1)"),
        (waits_by_the_clock, "std::this_thread::sleep_for(10ms);"),
        (machine_paths, 'path = "/home/somebody/urto"'),
        (unfinished_marks, "// TODO: later"),
        (borrowed_headers, "#include <cmath>\nconst int most = std::max({1, 2});"),
        (undocumented, "// A thing.\n\nmessage Thing {\n  uint32 id = 1;  // its id\n\n\n  double size = 2;\n}"),
        (undocumented, "\nmessage Thing {\n  uint32 id = 1;\n}"),
    ],
)
def test_a_rule_finds_a_fault(rule, fault):
    assert rule(fault) != []


@pytest.mark.parametrize(
    "rule, good",
    [
        (lambda text: wrong_includes("room", text), '#include "physics/world.h"\n#include <vector>'),
        (waits_by_the_clock, "await asyncio.sleep(0)"),
        (borrowed_headers, "#include <algorithm>\nstd::sort(a, b);"),
        (machine_paths, "see docs/protocol.md and https://example.org/home/page"),
        (undocumented, "// A thing.\nmessage Thing {\n  double size = 1;  // m\n}"),
    ],
)
def test_a_rule_lets_good_text_pass(rule, good):
    assert rule(good) == []
