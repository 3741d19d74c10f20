"""What the tests are worth: makes the small mistakes (mutants) of mutants.toml and notes which test finds each.

usage: mutants.py WORK [--only TEXT] [--numbers N,...] [--rooms | --then] [--built] [--jobs N] [--table FILE]
       mutants.py --check

WORK      a folder for a copy of the sources, its build and the answers so far; a second call goes on where the first one stopped
--only    mutants whose file contains TEXT
--numbers these mutants, from 0 in the order of the file; they are run again, whatever the answer was
--rooms   runs the tests of the mutant's room alone; by default the tests of `then` follow where these find nothing
--then    runs the tests of `then` alone: what they are worth by themselves
--built   takes the build that is in WORK as it is, though the sources may have changed since
--table   writes the answers of all stages as a page of Markdown, such as last_run.md
--check   only compares mutants.toml with the sources, and last_run.md with it: each row is a mutant that still exists, in the same order

All mutants are compiled into one program; the environment variable VIBROTROUGH_MUTANT chooses the one that is alive. So sixty mutants cost
one build. The work tree stays as it is.
"""

import argparse
import functools
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time
import tomllib
from typing import Any

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
# The room app has no tests of its own: `then` names those of its commands.
WITHOUT_TESTS = {"app"}
# Their tests are in Python, and need nothing but the program.
IN_PYTHON = {"end_to_end", "clusters"}
# Tests of a room that compare pages or start ParaView find no mistake of arithmetic, and take long.
LEFT_OUT = "InTheDocs|InParaView|RenderCase"
# How an answer begins where ctest itself failed, so that it does not name a test.
NO_TEST = "ctest: "

TITLE = """# The last run of the mutants

Written by `mutants.py --table`. [README.md](README.md#last-run) says how it was run.
"""
HEADER = """#ifdef __cplusplus
#include <cstdlib>
inline bool vibrotrough_mutant(int number) {
    static int const alive = [] { char const* const text = std::getenv("VIBROTROUGH_MUTANT"); return text ? std::atoi(text) : -1; }();
    return alive == number;
}
#endif
"""


def with_choice(mutant: dict[str, Any], number: int) -> str:
    """The line of a mutant, which is as before unless the mutant with this number is alive."""
    line, expression, becomes = mutant["line"], mutant["expression"], mutant["becomes"]
    if not becomes:
        return f"if (!vibrotrough_mutant({number})) {line}"
    return line.replace(expression, f"(vibrotrough_mutant({number}) ? ({becomes}) : ({expression}))")


def bring(name: pathlib.Path, content: bytes) -> None:
    """Writes a file unless it has this content: then its time stays, and it is not compiled again."""
    if not (name.is_file() and name.read_bytes() == content):
        name.parent.mkdir(parents=True, exist_ok=True)
        name.write_bytes(content)


def copy_sources(target: pathlib.Path, mutants: list[dict[str, Any]]) -> None:
    """The files of the work tree, with all mutants in them."""
    listed = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-co", "--exclude-standard", "-z"], stdout=subprocess.PIPE, text=True, check=True)
    names = {name for name in listed.stdout.split("\0") if name and (ROOT / name).is_file()}
    of_file: dict[str, list[int]] = {}
    for number, mutant in enumerate(mutants):
        of_file.setdefault("src/" + mutant["file"], []).append(number)
    for name in sorted(names):
        content = (ROOT / name).read_bytes()
        if name in of_file:
            lines = content.decode().split("\n")
            for number in of_file[name]:
                places = [i for i, line in enumerate(lines) if line.strip() == mutants[number]["line"]]
                if len(places) != 1:
                    sys.exit(f"{name} has this line {len(places)} times; write the mutant again: {mutants[number]['line']}")
                lines[places[0]] = with_choice(mutants[number], number)
            content = "\n".join(lines).encode()
        bring(target / name, content)
        shutil.copymode(ROOT / name, target / name)


def check_lines(mutants: list[dict[str, Any]]) -> int:
    """Names the mutants whose line their file does not have once; their number."""
    wrong = []
    for mutant in mutants:
        path = ROOT / "src" / mutant["file"]
        lines = path.read_text(encoding="utf-8").split("\n") if path.is_file() else []
        if sum(line.strip() == mutant["line"] for line in lines) != 1:
            wrong.append(f"{mutant['file']}: {mutant['line']}")
    print(f"{len(wrong)} of {len(mutants)} mutants have no line of their own; write them again:", *wrong, sep="\n")
    return len(wrong)


def build(work: pathlib.Path, jobs: int, targets: list[str]) -> pathlib.Path:
    bring(work / "mutant.hpp", HEADER.encode())
    folder = work / "build"
    # Optimised less than a release: most of the time goes into compiling.
    for command in (["cmake", "-G", "Ninja", "-S", str(work / "source"), "-B", str(folder), "-DCMAKE_BUILD_TYPE=Release",
                     "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", f"-DCMAKE_CXX_FLAGS=-include {work / 'mutant.hpp'}"],
                    ["cmake", "--build", str(folder), "--parallel", str(jobs), "--target", *targets, "--", "-k", "0"]):
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if done.returncode:
            sys.exit(done.stdout)
    return folder


def run_tests(folder: pathlib.Path, jobs: int, number: int | None, tests: str, left_out: str) -> str:
    """Runs the tests that match `tests` until one fails: its name, or nothing. Without a number no mutant is alive."""
    command = ["ctest", "--test-dir", str(folder), "-C", "nightly", "--parallel", str(jobs), "--stop-on-failure", "--no-tests=error", "--timeout", "120", "-R", tests, "-E", left_out]
    environment = {**os.environ, "VIBROTROUGH_MUTANT": "-1" if number is None else str(number)}
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment, check=False)
    if done.returncode == 0:
        return ""
    failed = re.search(r"Test +#\d+: (\S+) \.+\**(Failed|Timeout|Exception|Not Run|\*\*\*)", done.stdout)
    return failed[1] if failed else NO_TEST + done.stdout[-200:]


@functools.cache
def passes(folder: pathlib.Path, jobs: int, test: str) -> bool:
    """Whether a test passes when no mutant is alive."""
    return not run_tests(folder, jobs, None, f"^{re.escape(test)}$", LEFT_OUT)


def first_failure(folder: pathlib.Path, jobs: int, number: int, tests: str) -> str:
    """The test that finds a mutant, or nothing. A test that fails without any mutant, too, finds nothing: it may be older than the code, or
    too slow on a busy machine."""
    left_out = LEFT_OUT
    while True:
        found = run_tests(folder, jobs, number, tests, left_out)
        if not found or found.startswith(NO_TEST) or passes(folder, jobs, found):
            return found
        left_out += f"|^{re.escape(found)}$"


def then_pattern(names: list[str]) -> str:
    """The tests with these names, and what each of them adds at night."""
    return "^(" + "|".join(map(re.escape, names)) + r")(\.whole)?$"


def examine(folder: pathlib.Path, jobs: int, number: int, mutant: dict[str, Any], stages: set[str]) -> dict[str, Any]:
    start = time.monotonic()
    room = mutant["file"].split("/")[0]
    found = ""
    if "rooms" in stages and room not in WITHOUT_TESTS:
        found = first_failure(folder, jobs, number, rf"^{room}\.")
    if not found and "then" in stages and "then" in mutant:
        found = first_failure(folder, jobs, number, then_pattern(mutant["then"]))
    return {"by": found, "seconds": round(time.monotonic() - start)}


def key(mutant: dict[str, Any]) -> str:
    return " ~ ".join(mutant[name] for name in ("file", "line", "expression", "becomes"))


def beginning_of_row(mutant: dict[str, Any]) -> str:
    """The cells of the table that say which mutant it is."""
    cells = [mutant["file"], f"`{mutant['expression']}`", f"`{mutant['becomes']}`" if mutant["becomes"] else "(dropped)"]
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def read_answers(notes: pathlib.Path) -> dict[str, Any]:
    answers: dict[str, Any] = json.loads(notes.read_text()) if notes.exists() else {}
    return answers


def verdict(mutant: dict[str, Any], stages: list[dict[str, Any]]) -> tuple[str, int] | None:
    """What finds a mutant, and the time of all stages that were run; nothing, if none was."""
    known = [answers[key(mutant)] for answers in stages if key(mutant) in answers]
    if "equivalent" in mutant:
        return f"equivalent: {mutant['equivalent']}", 0
    if not known:
        return None
    found = next((answer["by"] for answer in known if answer["by"]), "**nothing**")
    return found, sum(answer["seconds"] for answer in known)


def write_table(path: pathlib.Path, mutants: list[dict[str, Any]], stages: list[dict[str, Any]]) -> None:
    rows = [TITLE, "| file | expression | becomes | found by | s |", "|---|---|---|---|--:|"]
    for mutant in mutants:
        if answer := verdict(mutant, stages):
            rows.append(f"{beginning_of_row(mutant)} {answer[0]} | {answer[1]} |")
    path.write_text("\n".join(rows) + "\n")


def check_table(path: pathlib.Path, mutants: list[dict[str, Any]]) -> int:
    """Names the rows of a written table that are no mutant, or not in the order of the file; their number."""
    begins = [beginning_of_row(mutant) for mutant in mutants]
    rows = [row for row in path.read_text(encoding="utf-8").splitlines() if row.startswith("| ") and not row.startswith("| file |")]
    at, wrong = 0, []
    for row in rows:
        places = [i for i in range(at, len(begins)) if row.startswith(begins[i] + " ")]
        if places:
            at = places[0] + 1
        else:
            wrong.append(row)
    print(f"{len(wrong)} of {len(rows)} rows of {path.name} are no mutant of mutants.toml; run them again with --table", *wrong, sep="\n")
    return len(wrong) if rows else 1


def targets(mutants: list[dict[str, Any]], stages: set[str]) -> list[str]:
    """What has to be built for the tests of these stages."""
    rooms = {mutant["file"].split("/")[0] for mutant in mutants} - WITHOUT_TESTS if "rooms" in stages else set()
    named = {name.split(".")[0] for mutant in mutants for name in mutant.get("then", [])} - IN_PYTHON if "then" in stages else set()
    return ["vibrotrough", *(f"{room}_tests" for room in sorted(rooms | named))]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("work", type=pathlib.Path, nargs="?")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--only", default="")
    parser.add_argument("--numbers", type=lambda text: {int(one) for one in text.split(",")})
    parser.add_argument("--rooms", action="store_true")
    parser.add_argument("--then", action="store_true")
    parser.add_argument("--built", action="store_true")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--table", type=pathlib.Path)
    chosen = parser.parse_args()
    mutants = tomllib.loads((HERE / "mutants.toml").read_text())["mutant"]
    if chosen.check:
        return 1 if check_lines(mutants) + check_table(HERE / "last_run.md", mutants) else 0
    if not chosen.work:
        parser.error("WORK is missing")
    stages = {"rooms"} if chosen.rooms else {"then"} if chosen.then else {"rooms", "then"}
    os.nice(max(0, 10 - os.nice(0)))
    work = chosen.work.resolve()
    folder = work / "build"
    wanted = {number: mutant for number, mutant in enumerate(mutants)
              if chosen.only in mutant["file"] and (chosen.numbers is None or number in chosen.numbers)
              and "equivalent" not in mutant and not (chosen.then and "then" not in mutant)}
    if not chosen.built:
        copy_sources(work / "source", mutants)
        folder = build(work, chosen.jobs, targets(list(wanted.values()), stages))
    notes = work / f"answers-{'-'.join(sorted(stages))}.json"
    answers = read_answers(notes)
    missed = []
    for number, mutant in wanted.items():
        if key(mutant) not in answers or chosen.numbers is not None:
            answers[key(mutant)] = examine(folder, chosen.jobs, number, mutant, stages)
            notes.write_text(json.dumps(answers, indent=1) + "\n")
            print(f"{number} {mutant['file']}: {mutant['expression']} -> {mutant['becomes']}: {answers[key(mutant)]}", flush=True)
        if not answers[key(mutant)]["by"]:
            missed.append(key(mutant))
    if chosen.table:
        write_table(chosen.table, mutants, [read_answers(work / f"answers-{name}.json") for name in ("rooms", "rooms-then", "then")])
    print(f"{len(missed)} mutants were found by nothing", *missed, sep="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
