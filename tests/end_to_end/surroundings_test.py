"""The program starts and works in whatever surroundings its parent leaves: locales, signals, limits, closed streams, home folders."""

import itertools
import json
import os
import re
import resource
import shutil
import signal
import stat
import subprocess
import unittest
from pathlib import Path

from trough_program import PROGRAM, EndToEndTest, sample

ONE = {"measure.max_cycles": 24}
# Compiled here without root's rights, from Debian's package "locales": (definition, character map, name).
COMPILED = (("de_DE", "UTF-8", "de_DE.UTF-8"), ("tr_TR", "UTF-8", "tr_TR.UTF-8"), ("fr_FR", "ISO-8859-1", "fr_FR"), ("ja_JP", "EUC-JP", "ja_JP.eucJP"))
LOCALES = ("C", "POSIX", "C.UTF-8", *(name for _, _, name in COMPILED), "en_US.UTF-8", "UTF-8", "xx_YY", "en_US.utf8@euro", "../etc")
VARIABLES = ("LC_ALL", "LC_CTYPE", "LC_NUMERIC", "LC_MESSAGES", "LANG")

# Commands whose answers hold times of the machine.
TIMED = ("--version", "theory map")

POINT = ("--throw-number", "2", "--vibration-angle", "30 deg", "--friction", "0.3")
# What each command is started with; {c} a campaign file, {r} its folder, {o} a place for output. A command that the program has and
# this table has not fails the test. Where no exit code is named it is 0.
ARGUMENTS = {
    "init": ("--output", "{o}.toml"), "run": ("{c}", "--output", "{r}"), "plan": ("{c}",), "prepare": ("{c}", "--task-list", "{o}", "--output", "{r}"),
    "work": ("{r}", "--task-list", "{c}", "--index", "0"), "keys": (), "quantities": (), "deck": ("{c}", "--output", "{o}"), "measure": ("{r}",), "observe": ("--examples",),
    "status": ("{r}",), "friction-test": ("{c}", "--output", "{r}", "--liggghts", "/nonexistent"), "convergence": ("{r}", "--liggghts", "/nonexistent"),
    "capacity": ("{c}", "--output", "{r}"), "compare": ("{r}", "--csv"), "archive": ("{r}", "--output", "{o}.zip"), "learn": ("{c}", "--half-width", "0.03", "--budget", "1 core-hours"),
    "predict": ("{r}", "--at", "throw_number=1.9"), "calibrate": ("{r}", "--measured", "{s}", "--free", "trough.friction"),
    "design": ("--mass-flow", "12 t/h", "--bulk-density", "600 kg/m3", "--width", "300 mm", "--friction", "nothing"), "export": ("{r}",),
    "plot": ("{r}", "--python", "/nonexistent"), "report": ("{r}", "--python", "/nonexistent"), "check": ("{c}",),
    "validate": ("--list",), "cite": (), "manual": (), "completion": ("bash",),
    "theory point": POINT, "theory trace": POINT,
    "theory map": ("--x", "throw_number=1:2:4", "--y", "vibration_angle_deg=5:60:4", "--friction", "0.35", "--output", "{o}.h5"),
    "theory limits": ("--friction", "0.35", "--tan-inclination", "-0.1", "--tan-vibration-angle", "0.5"),
    "theory friction": ("--machine-number", "1.5", "--max-relative-displacement", "1.9"),
    "theory design": ("--friction", "0.3", "--machine-number", "4", "--stroke", "nothing"), "theory batch": ("{s}", "--output", "{o}.csv"),
    "theory calibrate": ("{s}", "--free", "friction"), "page": ("{r}", "--output", "{o}.html"),
    "tutorial": ("design",),
}  # fmt: skip


def commands(*path):
    """All commands that have no commands of their own, as the program's help names them."""
    text = subprocess.run([PROGRAM, *path, "--help"], capture_output=True, text=True, check=True).stdout
    _, found, listed = text.partition("\nSubcommands:\n")
    names = re.findall(r"^  (\S+)", listed.split("\n\n")[0], flags=re.MULTILINE) if found else []
    return [one for name in names for one in commands(*path, name)] or [" ".join(path)]


class Surroundings(EndToEndTest):
    def start(self, *arguments, **settings):
        """Runs the program to its end; a minute is a hundred times what these calls need."""
        return subprocess.run([PROGRAM, *map(os.fspath, map(lambda a: a if isinstance(a, bytes) else str(a), arguments))], capture_output=True, timeout=60, **settings)

    def assert_limit(self, done, *parts):
        error = done.stderr.decode()
        self.assertEqual(done.returncode, 3, error)
        self.assertRegex(error.splitlines()[-1], r"\Avibrotrough: ")
        for part in parts:
            self.assertIn(part, error.splitlines()[-1])

    def compile_locales(self, *names):
        """The folder with these locales, each of which is compiled once."""
        folder = Path(self.common.name) / "locales"
        folder.mkdir(exist_ok=True)
        for definition, characters, name in COMPILED:
            if name in names and not (folder / name).exists():
                subprocess.run(["localedef", "--no-archive", "-i", definition, "-f", characters, str(folder / name)], check=True)
        return folder

    def test_every_command_in_twelve_locales(self):
        self.assertEqual(len(LOCALES), 12)
        self.assertEqual(sorted(commands()), sorted(ARGUMENTS))
        folder = self.compile_locales(*(name for _, _, name in COMPILED))
        comma = subprocess.run(["locale", "decimal_point"], env={"LOCPATH": str(folder), "LC_ALL": "de_DE.UTF-8", "PATH": os.environ["PATH"]}, capture_output=True, text=True)
        self.assertEqual(comma.stdout, ",\n", "the test is about a decimal comma")
        campaign = self.finished_campaign(ONE, wanted=0)
        plain = {name: value for name, value in os.environ.items() if not name.startswith(("LC_", "LANG"))}
        (self.folder / "speeds.csv").write_text("throw_number,vibration_angle_deg\n2,30\n")

        def answers(name, environment):
            place = self.folder / "out"
            shutil.rmtree(place, ignore_errors=True)
            place.mkdir()
            words = {"c": campaign, "r": self.output, "o": place / "one", "s": self.folder / "speeds.csv"}
            done = self.start(*name.split(), *(word.format(**words) for word in ARGUMENTS[name]), env=environment)
            self.assertNotIn(b"internal error", done.stderr)
            # Times, and what was done before, may differ.
            return done.returncode, re.sub(rb"[0-9.]+ (s|microseconds|core-hours)", b"", done.stdout), done.stderr.splitlines()[-1:]

        answers("run", plain)  # which probes the engine
        places = list(zip(LOCALES, itertools.cycle(VARIABLES)))
        for name, some in itertools.groupby(sample(itertools.product(["--version", *ARGUMENTS], places), 23), key=lambda pair: pair[0]):
            ARGUMENTS.setdefault(name, ())
            wanted = answers(name, plain)
            for _, (place, variable) in some:
                with self.subTest(command=name, locale=place, variable=variable):
                    found = answers(name, dict(plain, LOCPATH=str(folder), **{variable: place}))
                    self.assertEqual(found, wanted if name not in TIMED else (wanted[0], *found[1:]))

    def test_no_decimal_comma_reaches_engine_or_python(self):
        campaign = self.write_campaign(ONE)
        tables = []
        locales = self.compile_locales("de_DE.UTF-8")
        for place in ("C", "de_DE.UTF-8"):
            folder = self.folder / f"runs {place}"
            environment = dict(os.environ, LC_ALL=place, LOCPATH=str(locales))
            noted = self.folder / f"locale {place}"
            os.environ["VIBROTROUGH_TEST_BREAK"] = environment["VIBROTROUGH_TEST_BREAK"] = f'locale > "{noted}"'
            done = self.start(*self.run_arguments(campaign, folder), env=environment)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn('LC_NUMERIC="C"', noted.read_text())
            tables.append([path.read_bytes() for path in sorted(folder.glob("cases/*/packing-*/cycles.csv"))])
        drawn = self.start("plot", folder, "--only", "cycles", env=environment)
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        self.assertEqual(tables[0], tables[1])
        self.assertEqual(len(tables[0]), 2)

    def test_signals_of_the_parent(self):
        campaign = self.write_campaign(ONE)
        for number, prepare in enumerate((lambda: signal.signal(signal.SIGCHLD, signal.SIG_IGN), lambda: signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGCHLD]))):
            folder = self.folder / f"runs-{number}"
            for command in (self.run_arguments(campaign, folder), ("plot", folder, "--only", "cycles")):
                done = self.start(*command, preexec_fn=prepare)
                self.assertEqual(done.returncode, 0, done.stderr)

    def test_closed_streams(self):
        self.finished_campaign(ONE, wanted=0)
        drawing, quick = (["report", self.output], ["plot", self.output, "--only", "cycles", "--only", "profiles"]), (["status", self.output], ["validate", "--list"])
        streams = (([1], 3), ([0], 0), ([0, 1], 3))
        for (closed, wanted), command in sample(itertools.product(streams, drawing), 5) + list(itertools.product(streams, quick)):
            with self.subTest(closed=closed, command=command[0]):
                shutil.rmtree(self.output / "report", ignore_errors=True)
                done = self.start(*command, preexec_fn=lambda: [os.close(stream) for stream in closed])
                self.assertEqual(done.returncode, wanted, done.stderr)
                if wanted:
                    self.assertRegex(done.stderr.decode(), r"\Avibrotrough: cannot write the output [^\n]*\n\Z")
                if command in drawing:
                    self.assertTrue(list((self.output / "report").glob("profiles-*.png")), "all figures are drawn")

    def test_homes_and_umasks(self):
        campaign = self.write_campaign(ONE)
        plain = {name: value for name, value in os.environ.items() if name not in ("HOME", "XDG_CACHE_HOME")}
        for number, (home, umask) in enumerate(sample(((None, 0o077), (None, 0o022), ("/proc", 0)), 2)):  # nobody can write in /proc
            folder = self.folder / f"runs-{number}"
            environment = plain if home is None else dict(plain, HOME=home)
            for command in (self.run_arguments(campaign, folder), ("plot", folder, "--only", "cycles")):
                done = self.start(*command, env=environment, umask=umask)
                self.assertEqual(done.returncode, 0, done.stderr)
            modes = {path: stat.S_IMODE(path.stat().st_mode) for path in folder.rglob("*")}
            self.assertEqual([path for path, mode in modes.items() if mode & 0o002 or not mode & 0o600], [], "nobody else can write")

    def test_open_files(self):
        campaign = self.write_campaign(ONE)
        for count, wanted in ((4, 3), (14, 3), (64, 0)):
            done = self.start(*self.run_arguments(campaign), preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (count, count)))
            if wanted:
                self.assert_limit(done, "open files", f"limit of this process is {count}", "ulimit -n")
            else:
                self.assertEqual(done.returncode, 0, done.stderr)
        for count, wanted in ((4, 3), (14, 0), (64, 0)):
            done = self.start("compare", self.output, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (count, count)))
            self.assertEqual(done.returncode, wanted, done.stderr)

    def test_sizes_of_files(self):
        campaign = self.finished_campaign(ONE, wanted=0)
        for size in (0, 20_000):
            limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))  # noqa: E731
            for command in (["plot", self.output], ["archive", self.output, "--output", self.folder / "x.zip"], self.run_arguments(campaign, self.folder / f"new-{size}"),
                            ["theory", "map", "--x", "throw_number=1:2:90", "--y", "vibration_angle_deg=5:60:90", "--friction", "0.35", "--output", self.folder / "map.h5"]):  # fmt: skip
                with self.subTest(size=size, command=command[0]):
                    self.assert_limit(self.start(*command, preexec_fn=limit), "File too large", "ulimit -f")
            self.assertEqual(list(self.folder.glob("*.part-*")), [], "nothing is left")
        # Enough for the program's own files, and too little for the engine's.
        done = self.start(*self.run_arguments(campaign, self.folder / "engine"), preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000)))
        self.assertEqual(done.returncode, 1, done.stderr)
        (failure,) = (self.folder / "engine").glob("cases/*/failure.json")
        self.assertEqual(json.loads(failure.read_text())["outcome"], "disk-full")
        self.assertIn("ulimit -f", failure.read_text())

    def test_an_engine_whose_path_is_not_utf8(self):
        campaign = self.write_campaign(ONE)
        folder = os.fsencode(self.folder) + b"/eng\xffine\xc3"
        os.mkdir(folder)
        engine = folder + b"/liggghts"
        shutil.copy(self.engine, engine)
        done = self.start("run", campaign, "--output", self.output, "--liggghts", engine)
        self.assertEqual(done.returncode, 0, done.stderr)
        stored = json.loads((self.output / "engine.json").read_text(encoding="utf-8"))["program"]
        self.assertEqual(re.sub(rb"\0(..)", lambda byte: bytes.fromhex(byte[1].decode()), stored.encode()), engine)
        (case,) = (self.output / "cases").iterdir()
        for path in (case / "result.h5", case / "packing-1"):
            shutil.rmtree(path) if path.is_dir() else path.unlink()
        (self.folder / "tasks").write_text(f"{case.name} 1\n")
        for command in (["work", self.output, "--task-list", self.folder / "tasks", "--index", 0], ["report", self.output]):
            done = self.start(*command)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.take_starts(), [f"{case.name}/packing-1"] * 2 + [f"{case.name}/packing-2"])

    def test_few_processes(self):
        """As an ordinary user, because the limit does not hold for root."""
        self.assertEqual(os.geteuid(), 0, "this test changes the user")
        campaign = self.finished_campaign(ONE, wanted=0)
        user = 64999  # of nobody else, whose processes would be counted
        subprocess.run(["chown", "-R", str(user), str(self.folder)], check=True)
        os.chmod(self.folder, 0o755)
        environment = dict(os.environ, HOME=str(self.folder), XDG_CACHE_HOME=str(self.folder / "cache"))
        ids = ("setpriv", f"--reuid={user}", f"--regid={user}", "--clear-groups")
        map_words = [*ARGUMENTS["theory map"][:-1], self.folder / "map.h5"]
        commands = (["plot", self.output, "--only", "cycles"], self.run_arguments(campaign, self.folder / "new"), ["compare", self.output], ["theory", "map", *map_words])
        for count, command in sample(itertools.product((1, 2, 3, 5, 7), commands), 3):
            with self.subTest(count=count, command=command[0]):
                done = subprocess.run(["prlimit", f"--nproc={count}", *ids, PROGRAM, *map(str, command)], capture_output=True, timeout=60, env=environment)
                if done.returncode != 0:
                    self.assert_limit(done, "Resource temporarily unavailable", f"{count} processes", "ulimit -u")
                if command[0] == "run":
                    self.assertEqual(done.returncode, 3, "an engine needs more")
                if command[0] == "compare" or (command[0] == "plot" and count >= 5):
                    self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
