"""The published schema of scenes, judged by python3-jsonschema: what the reader accepts is valid, and what is structurally
wrong is not. Arguments: the program, the source folder."""
import copy
import json
import pathlib
import subprocess
import sys

try:
    import jsonschema
except ImportError:
    print("SKIP: python3-jsonschema is not installed")
    sys.exit(77)

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
SCHEMA = json.loads(subprocess.run([PROGRAM, "info", "--schema", "scene"], check=True, capture_output=True, text=True).stdout)
VALIDATOR = jsonschema.validators.validator_for(SCHEMA)(SCHEMA)


def accepted(scene):
    run = subprocess.run([PROGRAM, "simulate", "-", "--duration", "0"], input=json.dumps(scene), capture_output=True, text=True)
    return run.returncode == 0, run.stderr


def main():
    VALIDATOR.check_schema(SCHEMA)
    scenes = {str(path): json.loads(path.read_text()) for path in sorted((SOURCE / "presets/scenes").rglob("*.json"))}
    assert len(scenes) >= 7
    for name, scene in scenes.items():
        errors = [error.message for error in VALIDATOR.iter_errors(scene)]
        assert not errors, (name, errors[:2])
        ok, message = accepted(scene)
        assert ok, (name, message)

    plate = scenes[str(SOURCE / "presets/scenes/lab/plate.json")]
    wrong = 0
    for path, value in (
        (("duration_s",), -1), (("law",), "hertz"), (("strings",), []), (("colour",), 1),
        (("strings", 0, "modes", "plate", "count"), 0), (("strings", 0, "modes", "plate", "poissons_ratio"), 0.7),
        (("strings", 0, "hammers", 0, "mass_kg"), 0), (("strings", 0, "hammers", 0, "exponent"), 0.5),
        (("strings", 0, "contacts", 0, "restitution"), 2), (("strings", 0, "contacts", 0, "side"), "left"),
        (("strings", 0, "probes", 0, "quantity"), "speed"), (("strings", 0, "length_mm"), 1),
    ):
        scene = copy.deepcopy(plate)
        at = scene
        for key in path[:-1]:
            at = at[key]
        at[path[-1]] = value
        assert not VALIDATOR.is_valid(scene), path
        assert not accepted(scene)[0], path
        wrong += 1
    print(f"{len(scenes)} scenes are valid, {wrong} wrong ones are not")


main()
