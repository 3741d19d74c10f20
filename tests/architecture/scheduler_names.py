"""Each scheduler of clusters is named by its own file, its keys, its row and its page, and by nothing else in src/.

usage: scheduler_names.py SOURCE_FOLDER

Exit code 1 and one line for each other file that names one. The program's messages, the job scripts and the bookkeeping of batches are the
same for all of them, so that a further scheduler is one more file.
"""

import pathlib
import re
import sys
from collections.abc import Iterator

# What names a scheduler: its name and the names of its commands.
NAMES = {
    "slurm": re.compile(r"slurm|\b(?:sbatch|squeue|sacct|scancel|scontrol|sinfo)\b", re.IGNORECASE),
}
# Files that may, besides campaign/execute/NAME.cpp.
KEYS = {"scenario/model/run_settings.hpp", "scenario/model/run_settings.cpp", "scenario/reader/run_section.hpp", "scenario/reader/run_section.cpp"}
ROWS = {"campaign/execute/scheduler.hpp", "campaign/execute/executors.cpp"}
LINES_OF_A_ROW = 1
PAGES = {"BUILDING.md", "campaign/README.md", "app/commands.md", "scenario/README.md", "scenario/keys.md", "CHANGES.md"}
BUILD = {"campaign/CMakeLists.txt"}


def wrong_names(source: pathlib.Path) -> Iterator[str]:
    for path in sorted(source.rglob("*")):
        if path.suffix not in {".hpp", ".cpp", ".md", ".txt"}:
            continue
        file = str(path.relative_to(source))
        lines = path.read_text(encoding="utf-8").splitlines()
        for name, pattern in NAMES.items():
            found = [number for number, line in enumerate(lines, 1) if pattern.search(line)]
            if not found or file in KEYS | PAGES | BUILD | {f"campaign/execute/{name}.cpp"}:
                continue
            if file in ROWS and len(found) <= LINES_OF_A_ROW:
                continue
            yield f"{file}:{found[0]} names {name}: only campaign/execute/{name}.cpp, its keys, its row and its page may"


def main() -> None:
    found = list(wrong_names(pathlib.Path(sys.argv[1])))
    print("\n".join(found))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
