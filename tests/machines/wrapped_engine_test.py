"""The engine in a container and the program outside: .github/liggghts-in-container, with a stand-in for Apptainer that shows the engine
nothing of the machine but the system's folders and what is bound, and starts it elsewhere unless it is told the folder. And the
recipe for a campaign whose program is in the container, too."""

import os
import re
import shutil
import signal
import subprocess
import sys
import unittest
from pathlib import Path

from trough_program import PROGRAM, EndToEndTest, wait_until, without_wall_time

SOURCE = Path(os.environ["VIBROTROUGH_SOURCE"])
HERE = Path(__file__).parent
SKIPPED = 77


class InContainer(EndToEndTest):
    def setUp(self):
        super().setUp()
        programs = self.folder / "bin"
        programs.mkdir()
        shutil.copy(HERE / "apptainer", programs)
        self.wrapper = programs / "liggghts-in-container"
        shutil.copy(SOURCE / ".github/liggghts-in-container", self.wrapper)
        self.addCleanup(os.environ.update, PATH=os.environ["PATH"])
        os.environ["PATH"] = f"{programs}:{os.environ['PATH']}"
        self.engine = self.wrapper

    def test_a_campaign_is_the_same_as_without_a_container(self):
        campaign = self.write_campaign()
        tables = []
        for engine in (self.wrapper, Path(shutil.which("liggghts"))):
            self.engine = engine
            self.run_campaign(campaign, self.folder / engine.name)
            tables.append(without_wall_time(self.table(self.folder / engine.name)))
        self.assertEqual([row["outcome"] for row in tables[0]], ["finished"])
        self.assertEqual(*tables)

    def test_a_wrapper_that_forgets_the_folder_is_told_of(self):
        """The control: without --bind and --pwd the engine finds no deck, and the probes say so before a campaign begins."""
        text = self.wrapper.read_text(encoding="utf-8")
        self.wrapper.write_text(re.sub(r' --bind "\$PWD"| --pwd "\$PWD"', "", text), encoding="utf-8")
        self.run_campaign(self.write_campaign(), wanted=3)
        self.assertEqual(self.results(), [])

    def test_an_interrupted_engine_ends_in_its_container_too(self):
        process = self.start_campaign(self.write_campaign({"measure.max_cycles": 3000, "measure.packings": 12, "layer.grains": 300}))
        wait_until(lambda: list(self.output.rglob("cycles.csv")) and self.engines_of_children(), "an engine in its container", process)
        engines = self.engines_of_children()
        process.send_signal(signal.SIGINT)
        self.assertEqual(self.finish(process)[0], 130)
        wait_until(lambda: not [number for number in engines if Path(f"/proc/{number}").exists()], "the end of the engines")

    def engines_of_children(self):
        """Engines that name the folder of this test in their environment; their own folder is hidden by the container."""
        found = []
        for process in Path("/proc").iterdir():
            try:
                if (process / "comm").read_text() == "liggghts\n" and bytes(self.folder) in (process / "environ").read_bytes():
                    found.append(int(process.name))
            except OSError:
                pass  # ended meanwhile, or not a process
        return found

    def test_the_tasks_of_a_list_run_inside(self):
        """Program and engine in the container, the scheduler outside: the recipe for sites whose containers have no Slurm."""
        campaign = self.write_campaign()
        inside = ["apptainer", "exec", "--bind", str(self.folder), "--bind", str(Path(PROGRAM).parent), "--pwd", str(self.folder), "image.sif", PROGRAM]
        prepared = subprocess.run([*inside, "prepare", str(campaign), "--output", "runs", "--task-list", "tasks.txt", "--accept-findings"], capture_output=True, text=True)
        self.assertEqual(prepared.returncode, 0, prepared.stdout + prepared.stderr)
        count = int(re.search(r"for i from 0 to (\d+)", prepared.stdout)[1]) + 1
        for index in range(count):
            done = subprocess.run([*inside, "work", "runs", "--task-list", "tasks.txt", "--index", str(index)], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual([row["outcome"] for row in self.table(self.folder / "runs")], ["finished"])


if __name__ == "__main__":
    if os.geteuid() != 0 or not shutil.which("unshare"):
        print("the stand-in for Apptainer needs the rights of root and the program unshare")
        sys.exit(SKIPPED)
    unittest.main()
