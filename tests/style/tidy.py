"""clang-tidy on one room. Most of its time goes into the headers of the libraries, for each file anew; so the sources of a room are
checked together, as one file that includes them. Where the names of two anonymous namespaces meet, the later source waits for the
next such file. With this the sixteen rooms take a quarter of the time that they take batch by batch, as CMake compiles them."""

import json
import pathlib
import re
import shlex
import subprocess
import tempfile
from collections.abc import Sequence

# A check that costs nothing, to see whether the sources can be compiled together.
CHEAP_CHECK = "-*,misc-throw-by-value-catch-by-reference"


def _commands(build: pathlib.Path, sources: set[str]) -> tuple[dict[str, list[str]], list[str]]:
    """The compiler's arguments for each of `sources`, those that are compiled in batches (UNITY_BUILD) first; and if there is one batch of
    them, what it holds."""
    batched: dict[str, list[str]] = {}
    batches: list[list[str]] = []
    alone: dict[str, list[str]] = {}
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        file = pathlib.Path(entry["file"])
        arguments = shlex.split(entry["command"])
        if file.parent.name == "Unity":
            content = re.findall(r'^#include "(.*)"', file.read_text(encoding="utf-8"), flags=re.MULTILINE)
            batch = [path for path in (str(pathlib.Path(path).resolve()) for path in content) if path in sources]
            batched.update((path, arguments) for path in batch)
            batches += [batch] if batch else []
        else:
            alone[str(file.resolve())] = arguments
    return {path: arguments for path, arguments in (batched | alone).items() if path in sources}, batches[0] if len(batches) == 1 else []


def _shared_arguments(commands: Sequence[list[str]]) -> list[str]:
    """The options of the first command, and the folders and macros of all: one file holds what they compile."""
    first = [item for item in commands[0] if item not in ("-c", "ccache") and not item.endswith((".cpp", ".cxx", ".o", ".o.d"))]
    first = [item for item in first if item not in ("-MD", "-MT", "-MF", "-o", "-O3")]
    folders_and_macros: dict[str, None] = {}
    for arguments in commands:
        for item, value in zip(arguments, [*arguments[1:], ""]):
            if item.startswith(("-I", "-D")):
                folders_and_macros[item] = None
            elif item == "-isystem":
                folders_and_macros[f"-isystem{value}"] = None
    return [*first, *folders_and_macros]


class RoomTidy:
    """Runs clang-tidy (`program`) on sources of the project at `root` that lie in one file."""

    def __init__(self, program: str, root: pathlib.Path, folder: pathlib.Path) -> None:
        self._program, self._root, self._folder = program, root, folder

    def _run(self, commands: dict[str, list[str]], options: Sequence[str]) -> subprocess.CompletedProcess[str]:
        together = self._folder / "together.cpp"
        together.write_text("".join(f'#include "{path}"\n' for path in commands), encoding="utf-8")
        arguments = [*_shared_arguments(list(commands.values())), "-ferror-limit=0", "-c", str(together)]
        entry = {"directory": str(self._folder), "file": str(together), "arguments": arguments}
        (self._folder / "compile_commands.json").write_text(json.dumps([entry]), encoding="utf-8")
        return subprocess.run([self._program, "-quiet", "-p", str(self._folder), "--config-file", str(self._root / ".clang-tidy"), *options,
                               str(together)], cwd=self._root, capture_output=True, text=True, check=False)

    def _meeting_names(self, commands: dict[str, list[str]]) -> list[str]:
        """The sources that cannot be compiled after those before them."""
        said = self._run(commands, ["--checks", CHEAP_CHECK]).stdout
        wrong = {str(pathlib.Path(path).resolve()) for path in re.findall(r"^(/[^:]*):\d+:\d+: error: .*clang-diagnostic", said, flags=re.MULTILINE)}
        return [path for path in list(commands)[1:] if path in wrong]

    def violations(self, commands: dict[str, list[str]], batch: Sequence[str]) -> list[str]:
        """What clang-tidy says of the sources, line by line. Names within `batch` do not meet, as the compiler has seen."""
        answer: list[str] = []
        if batch:
            answer += self._said({path: commands[path] for path in batch})
            commands = {path: arguments for path, arguments in commands.items() if path not in batch}
        while commands:
            together, later = commands, list[str]()
            while wait := self._meeting_names(together):
                later += wait
                together = {path: arguments for path, arguments in together.items() if path not in wait}
            answer += self._said(together)
            commands = {path: arguments for path, arguments in commands.items() if path in later}
        return answer

    def _said(self, commands: dict[str, list[str]]) -> list[str]:
        done = self._run(commands, [])
        return ((done.stdout + done.stderr).splitlines() or [f"{self._program} ended with {done.returncode}"]) if done.returncode else []


def violations_of_room(program: str, root: pathlib.Path, build: pathlib.Path, sources: Sequence[str]) -> list[str]:
    """What clang-tidy says of `sources` (whole paths); a source that compile_commands.json of `build` does not compile is one line."""
    commands, batch = _commands(build, set(sources))
    left_out = [f"{path} is not compiled" for path in sources if path not in commands]
    with tempfile.TemporaryDirectory() as folder:
        return left_out + RoomTidy(program, root, pathlib.Path(folder)).violations(commands, batch)
