"""Checks the style of the sources and ends with 1 and a line for each violation.

usage: style.py CHECK ROOT [ARGUMENT...]

format          clang-format leaves every C++ file of src/ and tests/ as it is (.clang-format)
spelling        codespell finds no misspelt word in code and prose (.codespellrc)
lint            pyflakes finds nothing in the Python files
types CACHE     mypy finds nothing in the Python of postprocess/, validation/, tests/style/ and tests/architecture/ (.mypy.ini);
                CACHE is a folder that makes it faster
length          no source file is longer than 400 lines

ROOT is the folder of the project. Ends with 77 when the tool is missing or has another version than Debian 12's, whose
answer would differ.
"""

import pathlib
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterable

MOST_LINES = 400
SKIPPED = 77
CLANG_VERSION = "14."
MYPY_VERSION = "1.0."  # with the types of NumPy 1
# What codespell need not read: generated numbers, pictures, dumps, a corpus of damaged files.
NOT_PROSE = {".png", ".svg", ".h5", ".vti", ".vtp", ".dump", ".stl", ".csv", ".pyc"}
FOLDERS = ("src", "input_templates", "postprocess", "validation", "tests", ".github", ".ci")


def files(root: pathlib.Path, folders: Iterable[str], endings: Iterable[str]) -> list[pathlib.Path]:
    """The files below `folders` whose names end with one of `endings`, relative to `root`."""
    found = (path for folder in folders for path in (root / folder).rglob("*"))
    return sorted(path.relative_to(root) for path in found if path.suffix in endings and path.is_file())


def tool(*names: str, version: str = "") -> str:
    """The first of the programs that is there and whose --version says `version`."""
    for name in names:
        path = shutil.which(name)
        if path and version in subprocess.run([path, "--version"], capture_output=True, text=True, check=False).stdout:
            return path
    print(f"there is no {names[-1]}" + (f" of version {version}x" if version else "") + "; './setup packages all' lists what the tests need")
    sys.exit(SKIPPED)


def run(command: list[str], root: pathlib.Path, environment: dict[str, str] | None = None) -> list[str]:
    """What a tool says when it fails, line by line; nothing when it succeeds."""
    done = subprocess.run(command, cwd=root, env=environment, capture_output=True, text=True, check=False)
    return (done.stdout + done.stderr).splitlines() or [f"{command[0]} ended with {done.returncode}"] if done.returncode else []


def check_format(root: pathlib.Path) -> list[str]:
    program = tool("clang-format-14", "clang-format", version=CLANG_VERSION)
    return run([program, "--dry-run", "--Werror", *map(str, files(root, ("src", "tests"), (".hpp", ".cpp")))], root)


def check_spelling(root: pathlib.Path) -> list[str]:
    program = tool("codespell")
    below = [path for folder in FOLDERS for path in (root / folder).rglob("*")]
    prose = sorted(path for path in [*root.iterdir(), *below] if path.is_file() and path.suffix not in NOT_PROSE and "corpus" not in path.parts)
    return run([program, *(str(path.relative_to(root)) for path in prose)], root)


def python_files(root: pathlib.Path) -> list[pathlib.Path]:
    return files(root, ("postprocess", "validation", "tests"), (".py",))


def check_lint(root: pathlib.Path) -> list[str]:
    return run([tool("pyflakes3"), *map(str, python_files(root))], root)


def check_types(root: pathlib.Path, cache: str) -> list[str]:
    """Of the tests only those of sources have types. mypy takes longer to start than to check a script: folders are checked together
    where their modules have different names, through links under one folder, in which the package vibrotrough stays a folder. Nobody
    imports the many that are named run.py. What one group has found out of NumPy the next one need not: they share the cache."""
    program = tool("mypy", version=MYPY_VERSION)
    package = pathlib.Path("postprocess/vibrotrough")
    folders: dict[pathlib.Path, dict[str, pathlib.Path]] = {package: {package.name: package}}
    for path in files(root, ("postprocess", "validation", "tests/style", "tests/architecture"), (".py",)):
        if package in path.parents:
            continue
        name = f"{path.parent.name}_run.py" if path.name == "run.py" else path.name
        folders.setdefault(path.parent, {})[name] = path
    together: list[dict[str, pathlib.Path]] = []
    for scripts in folders.values():
        fitting = [group for group in together if not group.keys() & scripts.keys()]
        if fitting:
            fitting[0].update(scripts)
        else:
            together.append(dict(scripts))
    answer = []
    for number, group in enumerate(together):
        links = pathlib.Path(cache, f"links_{number}")
        shutil.rmtree(links, ignore_errors=True)
        links.mkdir(parents=True)
        for name, path in group.items():
            (links / name).symlink_to((root / path).resolve())
        search = {"MYPYPATH": f"{links}:{root / 'postprocess'}", "PATH": "/usr/bin:/bin"}
        command = [program, "--config-file", str(root / ".mypy.ini"), "--cache-dir", str(pathlib.Path(cache, "cache")), "--no-error-summary"]
        for line in run([*command, *sorted(group)], links, search):
            name, colon, rest = line.partition(":")
            answer.append(f"{group.get(name, name)}{colon}{rest}")
    return answer


def check_length(root: pathlib.Path) -> list[str]:
    sources = [*files(root, ("src", "tests"), (".hpp", ".cpp")), *python_files(root), pathlib.Path("setup")]
    lengths = {path: len((root / path).read_text(encoding="utf-8").splitlines()) for path in sources}
    return [f"{path}: {lines} lines, at most {MOST_LINES} are allowed" for path, lines in lengths.items() if lines > MOST_LINES]


CHECKS: dict[str, Callable[..., list[str]]] = {"format": check_format, "spelling": check_spelling, "lint": check_lint, "types": check_types,
                                               "length": check_length}


def main() -> None:
    name, root = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    violations = CHECKS[name](root, *sys.argv[3:])
    print("\n".join(violations) or f"{name}: no violation")
    sys.exit(1 if violations else 0)


if __name__ == "__main__":
    main()
