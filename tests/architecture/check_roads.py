"""The test's own test: roads that are put into a copy of src/ are found by roads.py.

usage: check_roads.py SOURCE_FOLDER WORK_FOLDER
"""

import pathlib
import shutil
import sys

from roads import wrong_roads

# What a hurried person may write: (file, text before which it is written, the code, what the test says).
ROADS = (
    ("app/commands/status.cpp", "int run_status", "void f() { campaign::PackingRun run; }", "names PackingRun"),
    ("learn/learner.cpp", "namespace vibrotrough", "void f() { engine::EngineProcess(context, engine, folder, nullptr); }", "names EngineProcess"),
    ("app/commands/deck.cpp", "namespace vibrotrough", 'void f() { std::system("liggghts"); }', "starts a program"),
    ("measure/landing.cpp", "namespace vibrotrough", 'void f() { ::execvp("liggghts", nullptr); }', "starts a program"),
    ("engine/run_report.cpp", "namespace vibrotrough", "void f() { std::ifstream file(path); }", "opens files past core"),
    ("view/scene.cpp", "namespace vibrotrough", 'void f() { fopen("x", "r"); }', "opens files past core"),
    ("campaign/execute/executors.cpp", "namespace vibrotrough", "void f() { ::open(path, 0); }", "opens files past core"),
    ("learn/speeds.cpp", "namespace vibrotrough", "void f() { auto json = nlohmann::json::parse(text); }", "reads JSON past core"),
    ("app/commands/work.cpp", "namespace vibrotrough", "// a comment on bp::child and std::ifstream is no road", ""),
)  # fmt: skip


def main() -> None:
    source, copy = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]) / "src with roads"
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(source, copy)
    for file, before, code, said in ROADS:
        text = (source / file).read_text(encoding="utf-8")
        assert before in text, (file, before)
        (copy / file).write_text(text.replace(before, f"{code}\n{before}", 1), encoding="utf-8")
        found = list(wrong_roads(copy))
        assert len(found) == (1 if said else 0) and all(file in one and said in one for one in found), (file, code, found)
        (copy / file).write_text(text, encoding="utf-8")
    # The gate is left out, or comes too late.
    for file, function in (("campaign/execute/campaign_driver.cpp", "run_campaign"), ("campaign/execute/packing_worker.cpp", "work")):
        text = (source / file).read_text(encoding="utf-8")
        place = text.index(f" {function}(")
        (copy / file).write_text(text[:place] + text[place:].replace("check_foreign_commands(", "ignore(", 1), encoding="utf-8")
        found = list(wrong_roads(copy))
        assert len(found) == 1 and "reaches the engine before check_foreign_commands()" in found[0], found
        (copy / file).write_text(text, encoding="utf-8")
    assert not list(wrong_roads(copy))
    shutil.rmtree(copy)


if __name__ == "__main__":
    main()
