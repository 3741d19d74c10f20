"""Finds the roads in src/ that lead to the engine, to other programs, and to files, and holds them to the gates.

usage: roads.py SOURCE_FOLDER

- Only the files of STARTERS start programs, each for the reason that stands there.
- What starts the engine (a class or function of ENGINE) is used by the files that stand there and by no others, from the process up to the
  gate: run_campaign() and work(), which call check_foreign_commands() before anything else.
- Outside of core/, only the files of OPENERS open files in another way than through core (open_to_read(), read_file(), ParentFolder), where
  nothing is waited for and only regular files are taken.
- JSON is read by core/note.cpp, which limits its depth, and by the files of NOTE_READERS.

Comments do not count. Exit code 1 and one line for each road that is not known; a row of the tables that no road needs is told, too.
"""

import pathlib
import re
import sys
from collections.abc import Iterator

START = re.compile(r"\bbp::(?:child|system|spawn|async_system)\b|\bposix_spawnp?\s*\(|\b(?:popen|system|fork|vfork|execv\w*|execl\w*|fexecve)\s*\(")
STARTERS = {
    "engine/engine.cpp": "the engine, and the question for its version",
    "engine/certificate.cpp": "ldd, which names the libraries of the engine",
    "campaign/execute/scheduler_call.cpp": "the commands of schedulers",
    "core/temporary_folder.cpp": "a copy of this process, which removes its folders when a signal ends it",
    "app/with_vtk.cpp": "the program's own part with VTK, from the program's folder",
    "app/python.cpp": "Python with the scripts of the program",
}
# What leads to the engine: where it may be named. The last ones are behind the gate.
ENGINE = {
    "EngineProcess": {"engine/engine.cpp", "engine/engine.hpp", "engine/probe.cpp", "campaign/execute/packing_run.cpp", "campaign/execute/packing_run.hpp",
                      "campaign/execute/settled_packings.cpp"},
    "SettledPackings": {"campaign/execute/settled_packings.cpp", "campaign/execute/settled_packings.hpp", "campaign/execute/packing_run.cpp",
                        "campaign/execute/packing_run.hpp", "campaign/execute/packing_worker.cpp", "campaign/execute/local_executor.cpp"},
    "PackingRun": {"campaign/execute/packing_run.cpp", "campaign/execute/packing_run.hpp", "campaign/execute/packing_worker.cpp",
                   "campaign/execute/local_executor.cpp"},
    "make_local_executor": {"campaign/execute/local_executor.cpp", "campaign/execute/local_executor.hpp", "campaign/execute/executors.cpp"},
    "Attempt": {"campaign/execute/packing_worker.cpp"},
    "kind.make": {"campaign/execute/campaign_driver.cpp"},
}  # fmt: skip
GATE = "check_foreign_commands"
# The gates: what must stand behind the call, within the function.
GATES = {
    ("campaign/execute/campaign_driver.cpp", "void add_cases("): "add_case(",
    ("campaign/execute/campaign_driver.cpp", "Summary run_campaign("): "kind.make",
    ("campaign/execute/packing_worker.cpp", "WorkResult work("): "Attempt running(",
}

OPEN = re.compile(r"\bstd::[io]?fstream\b|\bstd::filebuf\b|\bfopen\s*\(|\bfreopen\s*\(|(?<!\w)::open(?:at2?)?\s*\(|\barchive_read_open_filename\s*\(|\bH5F(?:open|create)\s*\(")
OPENERS = {
    "engine/engine.cpp": "/proc/PID/stat",
    "app/process.cpp": "/dev/null in place of a stream that was closed",
    "archive/zip_file.cpp": "a new file in an open folder; a bundle whose kind open_bundle() has looked at",
    "store/hdf5_memory_file.cpp": "a file in memory",
}

NOTE = re.compile(r"\b[jJ]son::(?:parse|sax_parse)\s*\(|>>\s*json\b")
NOTE_READERS = {
    "core/note.cpp": "the gate, which limits the depth",
    "scenario/reader/key_schema.cpp": "the program's own examples of keys",
}


def code_of(path: pathlib.Path) -> str:
    """The file without comments and texts."""
    text = re.sub(r'"(?:[^"\\\n]|\\.)*"', '""', path.read_text(encoding="utf-8"))
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.DOTALL)


def body_of(code: str, start: str) -> str:
    """The body of the function whose definition begins with `start`; empty when there is none."""
    place = code.find(start)
    if place < 0:
        return ""
    place = code.index("{", code.index(")", place))
    depth = 0
    for end in range(place, len(code)):
        depth += {"{": 1, "}": -1}.get(code[end], 0)
        if depth == 0:
            return code[place:end]
    return ""


def unknown_uses(codes: dict[str, str], pattern: re.Pattern[str], known: dict[str, str], what: str) -> Iterator[str]:
    users = {name for name, code in codes.items() if pattern.search(code)}
    yield from (f"{name} {what}, and is not in the table of tests/architecture/roads.py" for name in sorted(users - known.keys()))
    yield from (f"{name} no longer {what}: remove its row in tests/architecture/roads.py" for name in sorted(known.keys() - users))


def wrong_roads(source: pathlib.Path) -> Iterator[str]:
    codes = {str(path.relative_to(source)): code_of(path) for path in sorted(source.rglob("*.[ch]pp"))}
    yield from unknown_uses(codes, START, STARTERS, "starts a program")
    outside = {name: code for name, code in codes.items() if not name.startswith("core/")}
    yield from unknown_uses(outside, OPEN, OPENERS, "opens files past core")
    yield from unknown_uses(codes, NOTE, NOTE_READERS, "reads JSON past core/note.hpp")
    for word, known in ENGINE.items():
        users = {name for name, code in codes.items() if re.search(rf"\b{re.escape(word)}\b", code)}
        yield from (f"{name} names {word}, which leads to the engine past {GATE}()" for name in sorted(users - known))
    for (file, start), behind in GATES.items():
        body = body_of(codes.get(file, ""), start)
        if behind not in body:
            yield f"{file}: '{start}' does not lead to '{behind}' any more; look for the road to the engine"
        elif GATE not in body or body.index(GATE) > body.index(behind):
            yield f"{file}: '{start}' reaches the engine before {GATE}()"


def main() -> None:
    found = list(wrong_roads(pathlib.Path(sys.argv[1])))
    print("\n".join(found))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
