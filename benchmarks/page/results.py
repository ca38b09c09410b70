"""Reads the CSV files of docs/benchmarks and answers who is cheapest at which error."""
import csv
import math
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = ROOT / "docs" / "benchmarks"
SCENES = ("bass", "one-contact", "fretless", "smooth-bass", "guitar")
RESTITUTIONS = (0.0, 0.5, 0.9, 1.0)
NAMES = {"uniform": "uniform exact scheme", "theta=0.5": "Moreau-Jean, theta 1/2", "theta=1.0": "Moreau-Jean, theta 1",
         "penalty": "penalty (Hunt-Crossley)", "ieq-modal": "quadratised, modal", "ieq": "quadratised, finite differences",
         "sav": "SAV, finite differences"}
RIVALS = tuple(NAMES)
LAWS = ("signorini", "newton", "passive", "paoli-schatzman")


def read(name):
    with (DATA / f"{name}.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def work_precision():
    rows = read("work_precision")
    for row in rows:
        for key in ("restitution", "rate_hz", "cost", "compile_s", "error", "spectrum_dB", "error_first_position"):
            row[key] = float(row[key])
        row["own_error"] = float(row["error_to_own_finest"])
        # Both theta schemes are rivals of their own.
        row["rival"] = row["parameter"].split()[0] if row["method"] == "theta" else row["method"]
        row["fewer_modes"] = "N=" in row["parameter"]
    return rows


def select(rows, scene, restitution, method):
    return [row for row in rows if row["scene"] == scene and row["restitution"] == restitution
            and (row["rival"] == method or row["method"] == method == "exact")]


def cheapest(rows, error, measure="error"):
    """The cheapest run whose error is at most that, or None."""
    good = [row for row in rows if row[measure] <= error]
    return min(good, key=lambda row: row["cost"]) if good else None


def frontier(rows, measure="error"):
    """Runs that no other run of the list beats in both, by rising cost."""
    best, kept = math.inf, []
    for row in sorted(rows, key=lambda row: (row["cost"], row[measure])):
        if row[measure] < best:
            best = row[measure]
            kept.append(row)
    return kept


def lost(rows, scene, restitution, rival, measure="error", largest=math.inf):
    """Runs of the rival that are cheaper than ours at their error, or that reach an error that ours does not."""
    ours = select(rows, scene, restitution, "exact")
    found = []
    for row in frontier(select(rows, scene, restitution, rival), measure):
        if row[measure] > largest or not math.isfinite(row[measure]):
            continue
        best = cheapest(ours, row[measure], measure)
        if best is None or best["cost"] > row["cost"]:
            found.append((row, best))
    return found


def least_ratio(rows, scene, rival, measure, largest):
    """(smallest of the rival's cost over ours at equal error, its e) over all restitutions; None without such a run."""
    ratios = []
    for e in RESTITUTIONS:
        ours = select(rows, scene, e, "exact")
        for row in frontier(select(rows, scene, e, rival), measure):
            if row[measure] <= largest:
                best = cheapest(ours, row[measure], measure)
                ratios.append((row["cost"] / best["cost"] if best else 0.0, e))
    return min(ratios) if ratios else None
