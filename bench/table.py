"""The results of bench/run as tables."""

from __future__ import annotations

from typing import Any

Result = dict[str, Any]


def _engines(result: Result) -> list[str]:
    names: list[str] = []
    for rows in result["scenes"].values():
        names += [name for name in rows if name not in names]
    return names


def _cells(result: Result) -> tuple[list[str], list[list[str]]]:
    engines = _engines(result)
    peers = [name for name in engines if name != "urto"]
    head = ["scene", "bodies", "touching", *engines, *(f"urto / {peer}" for peer in peers)]
    lines = []
    for scene, rows in result["scenes"].items():
        ran: dict[str, Any] = next((row for row in rows.values() if "ms" in row), {})
        line = [scene, str(ran.get("bodies", "")), str(rows.get("urto", {}).get("touching", ran.get("touching", "")))]
        for engine in engines:
            row = rows[engine]
            line.append(f"{row['ms']:.3f}" if "ms" in row else row["missing"].split(":")[0])
        for peer in peers:
            ratio = rows[peer].get("urto_ratio")
            line.append("" if ratio is None else f"{ratio:.2f}")
        lines.append(line)
    return head, lines


def _caption(result: Result) -> str:
    threads = "one thread" if result["threads"] == 1 else f"{result['threads']} threads"
    quick = ", shortened scenes (--quick)" if result["quick"] else ""
    return f"Mean ms a step, {threads}, {result['figure']}, best of {result['rounds']} interleaved rounds{quick}"


def text_table(result: Result) -> str:
    head, lines = _cells(result)
    return _caption(result) + "\n" + _aligned(head, lines)


def _aligned(head: list[str], lines: list[list[str]]) -> str:
    widths = [max(len(row[column]) for row in [head, *lines]) for column in range(len(head))]
    rows = ["  ".join(cell.rjust(width) if i else cell.ljust(width) for i, (cell, width) in enumerate(zip(row, widths)))
            for row in [head, *lines]]
    return "\n".join(rows)


def _pipes(head: list[str], lines: list[list[str]]) -> list[str]:
    return ["| " + " | ".join(row) + " |" for row in [head, ["---"] + ["---:"] * (len(head) - 1), *lines]]


def _versions(result: Result) -> str:
    versions = {}
    for rows in result["scenes"].values():
        for engine, row in rows.items():
            if "ms" in row:
                versions[engine] = row["version"]
    return ", ".join(f"{engine} {version}" for engine, version in versions.items())


def markdown(result: Result) -> str:
    head, lines = _cells(result)
    machine = result["machine"]
    table = _pipes(head, lines)
    phases = ["", "Where Urto's time goes, mean ms a step:", ""]
    for scene, rows in result["scenes"].items():
        shares = rows.get("urto", {}).get("phases_ms")
        if shares:
            phases.append(f"- {scene}: " + ", ".join(f"{name} {ms:.3f}" for name, ms in shares.items()))
    about = [
        "",
        f"{result['started']}; {machine['processor']}, {machine['processors']} processors, "
        f"{', '.join(machine['simd']) or 'no x86 SIMD'}; {machine['system']}; {machine['c++']}; {machine['cargo']}.",
        f"Load average {machine['load at start']:.1f} at the start and {machine['load at end']:.1f} at the end.",
        f"{_versions(result)}; commit {machine['commit']}{' with changes' if machine['uncommitted changes'] else ''}.",
    ]
    return "\n".join([_caption(result) + ".", "", *table, *phases, *about]) + "\n"
