"""What a preset and the sets beside it are like: figures of each, distances between them."""
import itertools
import statistics

import notes
import properties
import sets

USUAL = str(notes.USUAL)


def mean(values):
    values = [v for v in values if v is not None]
    return statistics.fmean(values) if values else None


def median(values):
    values = [v for v in values if v is not None]
    return statistics.median(values) if values else None


def spectra_of(by_key, velocity=USUAL):
    return {key: found[velocity]["third_octaves"] for key, found in by_key.items()}


def distance(one, other):
    """Mean over the keys of `one` near which `other` has a spectrum, and how many keys that were."""
    pairs = [(levels, sets.spectrum_near(other, key)) for key, levels in one.items()] if other else []
    found = [properties.distance_db(a, b) for a, b in pairs if b is not None]
    return (statistics.fmean(found) if found else None), len(found)


def figures(by_key):
    """One number for each property of an instrument: means or medians over keys."""
    soft, loud = str(notes.SOFT), str(notes.LOUD)
    rows = list(by_key.values())
    result = {"thump_db": median(r[USUAL]["thump_db"] for r in rows),
              "high_soft_db": mean(r[soft]["high_db"] for r in rows), "high_loud_db": mean(r[loud]["high_db"] for r in rows),
              "brightening": mean(r[loud]["centroid_hz"] / max(r[soft]["centroid_hz"], 1) for r in rows),
              "correlation": mean(r[USUAL]["correlation"] for r in rows),
              "release_s": median(r[USUAL]["release_s"] for r in rows), "release_db": mean(r[loud]["release_db"] for r in rows)}
    for group in properties.GROUPS:
        result[f"t60_{group}_s"] = median(r[USUAL]["t60_s"][group] for r in rows)
    return result


def evenness(levels):
    """Of A-weighted levels by key: largest step between neighbouring keys of the list, and range [dB]."""
    rows = [levels[key] for key in sorted(levels, key=int)]
    steps = [abs(b - a) for a, b in zip(rows, rows[1:])]
    return {"step_db": max(steps, default=0.0), "range_db": max(rows) - min(rows), "peak_key": max(levels, key=levels.get)}


def reference_figures(facts):
    """What reference.json says of a recorded note, in the words of figures(); what it does not say is left out."""
    words = {"thump_db": "thump0", "t60_1-3_s": "T1_1-3", "t60_4-8_s": "T1_4-8", "t60_9-16_s": "T1_9-16", "correlation": "corr"}
    result = {name: facts[word] for name, word in words.items() if facts.get(word) is not None}
    bands = dict(zip((5000, 10000), facts.get("bands", [])[7:9]))
    if 5000 in bands:
        result["high_soft_db"] = result["high_loud_db"] = bands[5000]
    return result


COUPLING = ["late_over_early_1-3", "late_over_early_4-8", "late_over_early_9-16", "beat_db_1-3", "beat_db_4-8", "beat_db_9-16", "scatter_percent",
            "glide_cents", "between_db"]


def coupling_figures(by_key):
    """Medians over keys of notes that are held, at the usual velocity; the glide of loud ones."""
    usual = {word: median(r[USUAL][word] for r in by_key.values()) for word in COUPLING}
    return {**usual, "glide_cents": median(r[str(notes.LOUD)]["glide_cents"] for r in by_key.values())}


def middle_range(values):
    """Where all but the lowest and the highest tenth lie; None of fewer than three."""
    values = sorted(v for v in values if v is not None)
    if len(values) < 3:
        return None
    at = lambda share: values[round(share * (len(values) - 1))]  # noqa: E731
    return at(0.1), at(0.9)


def coupling_of_recordings(recorded, facts):
    """Range over single recorded notes, and over the sets that are known by figures alone."""
    words = {**{f"late_over_early_{g}": f"T2/T1_{g}" for g in properties.GROUPS}, **{f"beat_db_{g}": f"beat_{g}" for g in properties.GROUPS},
             "glide_cents": "glide"}
    result = {}
    for word in COUPLING:
        values = [note[word] for note in recorded]
        of_facts = [row[words[word]] for row in facts if word in words and row.get(words[word]) is not None]
        within = middle_range(values)
        if within or of_facts:
            result[word] = (min([*(within or ()), *of_facts]), max([*(within or ()), *of_facts]))
    return result


def is_of_fluid(label):
    return label == "fluid" or label.endswith("-fluid") or label.split(" ")[0].endswith("-fluid") or label in sets.KIN


def coupling(cache, preset, keys):
    """What the report says of notes that are held."""
    facts = sets.reference()["sets"].get(sets.ALIKE.get(preset.name, preset.name), {}).values()
    return {"name": preset.name, "figures": coupling_figures({key: preset.held(key) for key in keys}),
            "real": coupling_of_recordings(sets.held_notes(cache, preset.name), facts)}


def compare(cache, preset, keys, description):
    """Everything that the report says of one preset."""
    name = preset.name
    by_key = {key: preset.key(key) for key in keys}
    facts = sets.reference()
    recorded, missing = sets.recorded(cache, name)
    of_sets = {r.name: {key: r.key(key) for key in keys} for r in recorded}
    spectra = {label: spectra_of(found) for label, found in of_sets.items()}
    spectra.update(sets.reference_spectra(facts, name))
    mine = spectra_of(by_key)
    held_out = [*sets.HELD_OUT, *sets.REFERENCE_HELD_OUT.get(name, [])]
    distances = {label: distance(mine, other)[0] for label, other in spectra.items()}
    among = [distance(spectra[a], spectra[b])[0] for a, b in itertools.combinations(spectra, 2) if not (is_of_fluid(a) and is_of_fluid(b))]
    real = [figures(found) for found in of_sets.values()]
    real += [reference_figures(row) for row in facts["sets"].get(name, {}).values()]
    compass = sets.playable_keys(description)
    return {
        "name": name, "keys": keys, "missing": missing, "figures": {**figures(by_key), **evenness(preset.compass(compass)), **preset.phrase(compass)},
        "real": {p: (min(v), max(v)) for p in {q for row in real for q in row}
                 if (v := [row[p] for row in real if row.get(p) is not None])},
        "distances": {k: v for k, v in distances.items() if v is not None},
        "fitted_db": mean(v for k, v in distances.items() if k not in held_out),
        "held_out_db": mean(v for k, v in distances.items() if k in held_out),
        "among_db": mean(among), "spectra": {"preset": mine, **spectra},
    }
