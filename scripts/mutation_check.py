#!/usr/bin/env python3
"""Breaks the engine in one place after another and shows that a test fails for each.

The places are tests/mutation/mutations.json: a text that occurs once in a file of the engine, and what is put in its stead.
A copy of the tree is built in build/mutation with the engine's tests alone; nothing else is touched. The tests nearest to
the file run first, then those that take less than a second, then all. What was found is kept, so that a run that is
interrupted goes on where it stopped, and one after tests were added tries what survived; --again starts over. --current
builds nothing: it only says whether every place is still there.

usage: mutation_check.py [--jobs N] [--only TEXT] [--again] [--current]
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
WORK = ROOT / "build/mutation"
TREE = WORK / "tree"
BUILD = WORK / "build"
RESULTS = WORK / "results.json"


def copy_tree():
    """What is tracked, as it is in the working tree. Files that are right stay as they are: one that held a mutation when
    it was last compiled is newer than its object."""
    tracked = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    names = set(filter(None, tracked.split("\0")))
    for path in [path for path in TREE.rglob("*") if path.is_file() and str(path.relative_to(TREE)) not in names]:
        path.unlink()
    for name in names:
        target = TREE / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if not target.exists() or target.read_bytes() != (ROOT / name).read_bytes():
            shutil.copyfile(ROOT / name, target)


def build(jobs):
    run = subprocess.run(["cmake", "--build", BUILD, "--parallel", str(jobs), "--target", "engine_tests"],
                         capture_output=True, text=True)
    return run.returncode == 0, run.stdout[-2000:]


def configure():
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DJAWARI_BUILD_HOST=OFF", "-DJAWARI_BUILD_BENCHMARKS=OFF", "-G", "Ninja"]
    subprocess.run(["cmake", "-S", TREE, "-B", BUILD, *options], check=True, stdout=subprocess.DEVNULL)


def suites_near(file):
    """Test suites of the engine's file, or else of the files in its folder."""
    folder = ROOT / "tests/engine" / pathlib.Path(file).parent.relative_to("engine/src" if "src" in file else "engine/include/jawari")
    near = list(folder.glob(f"{pathlib.Path(file).stem}_test.cpp")) or folder.glob("*_test.cpp")
    return sorted({suite for path in near
                   for suite in re.findall(r"^TEST(?:_[FP])?\((\w+),", path.read_text(encoding="utf-8"), re.MULTILINE)})


def first_failure(times):
    """Name of a test that fails, or None if all of these pass; they may take ten times as long as they do."""
    if not times:
        return None
    command = [BUILD / "bin/engine_tests", "--gtest_brief=1", "--gtest_fail_fast", f"--gtest_filter={':'.join(times)}"]
    try:
        run = subprocess.run(command, capture_output=True, text=True, timeout=60 + 10 * sum(times.values()))
    except subprocess.TimeoutExpired:
        return "(tests did not end)"
    if run.returncode == 0:
        return None
    failed = [line for line in run.stdout.splitlines() if line.startswith("[  FAILED  ]")]
    return failed[0].split("]", 1)[1].split(",")[0].split("(")[0].strip() if failed else f"(exit {run.returncode})"


def tests_without_mutation():
    """Seconds that each test takes; ends the script if one fails."""
    report = WORK / "tests.json"
    report.unlink(missing_ok=True)
    command = [BUILD / "bin/engine_tests", "--gtest_brief=1", f"--gtest_output=json:{report}"]
    if subprocess.run(command, capture_output=True, text=True).returncode != 0:
        sys.exit("mutation_check.py: the engine's tests fail without any mutation")
    suites = json.loads(report.read_text(encoding="utf-8"))["testsuites"]
    return {f"{suite['name']}.{test['name']}": float(test["time"].rstrip("s"))
            for suite in suites for test in suite["testsuite"] if "time" in test}


def stale(mutations):
    """Mutations whose text does not occur once, with how often it does."""
    counts = [(m, (ROOT / m["file"]).read_text(encoding="utf-8").count(m["find"])) for m in mutations]
    return [(m, count) for m, count in counts if count != 1]


def key_of(mutation):
    return f"{mutation['file']}: {mutation['find']} -> {mutation['replace']}"


def try_mutation(mutation, jobs, times):
    path = TREE / mutation["file"]
    whole = path.read_text(encoding="utf-8")
    count = whole.count(mutation["find"])
    if count != 1:
        return {"outcome": "stale", "detail": f"the text occurs {count} times"}
    path.write_text(whole.replace(mutation["find"], mutation["replace"]), encoding="utf-8")
    try:
        built, output = build(jobs)
        if not built:
            return {"outcome": "does not compile", "detail": output.splitlines()[-1] if output else ""}
        suites = suites_near(mutation["file"])
        near = {name: time for name, time in times.items() if name.split(".")[0].split("/")[-1] in suites}
        quick = {name: time for name, time in times.items() if time < 1}
        failure = first_failure(near) or first_failure(quick) or first_failure(times)
        return {"outcome": "found", "detail": failure} if failure else {"outcome": "SURVIVED", "detail": ""}
    finally:
        path.write_text(whole, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--only", default="", help="mutations whose file or text contains this")
    parser.add_argument("--again", action="store_true", help="forget earlier results")
    parser.add_argument("--current", action="store_true", help="only check that every place is still there")
    options = parser.parse_args()
    mutations = json.loads((ROOT / "tests/mutation/mutations.json").read_text(encoding="utf-8"))
    chosen = [m for m in mutations if options.only in key_of(m)]
    if options.current:
        found = stale(chosen)
        for mutation, count in found:
            print(f"{mutation['file']}: {mutation['find']}: occurs {count} times, not once")
        sys.exit(bool(found))
    WORK.mkdir(parents=True, exist_ok=True)
    copy_tree()
    configure()
    built, output = build(options.jobs)
    if not built:
        sys.exit(f"mutation_check.py: the engine's tests do not build\n{output}")
    times = tests_without_mutation()
    earlier = {} if options.again or not RESULTS.exists() else json.loads(RESULTS.read_text(encoding="utf-8"))
    results = {key: result for key, result in earlier.items() if result["outcome"] == "found"}
    bad = 0
    for number, mutation in enumerate(chosen, 1):
        key = key_of(mutation)
        if key not in results:
            if sys.stderr.isatty():
                print(f"\r{number} of {len(chosen)} ", end="", file=sys.stderr)
            results[key] = try_mutation(mutation, options.jobs, times)
            RESULTS.write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")
        outcome = results[key]
        bad += outcome["outcome"] != "found"
        print(f"{outcome['outcome']:8}  {mutation['file']}: {mutation['find'].strip().splitlines()[0][:70]}  {outcome['detail']}",
              flush=True)
    print(f"{len(chosen) - bad} of {len(chosen)} mutations were found")
    sys.exit(bad > 0)


if __name__ == "__main__":
    main()
