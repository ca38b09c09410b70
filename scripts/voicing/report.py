"""The tables of docs/voicing.md, worst first, and its pictures."""
import re

STEP_DB, RANGE_DB, LUFS_SPREAD, RATIO, CORRELATION = 3.0, 8.0, 2.0, 1.2, 0.6  # what the presets aim at


def number(value, digits=1):
    return "" if value is None else f"{value:.{digits}f}"


def ratio_of(row):
    if row["among_db"] is None or row["fitted_db"] is None:
        return None
    return row["fitted_db"] / row["among_db"]


def worst_first(rows):
    """By the distance relative to that of the sets among themselves; then by the distance; those without sets last."""
    return sorted(rows, key=lambda r: (ratio_of(r) is None, r["fitted_db"] is None, -(ratio_of(r) or 0), -(r["fitted_db"] or 0), r["name"]))


def distances_table(rows):
    lines = ["| preset | to the sets it was fitted to (dB) | to sets held out (dB) | sets among themselves (dB) | ratio | each set (dB) |",
             "|---|---|---|---|---|---|"]
    for row in worst_first(rows):
        each = ", ".join(f"{label} {value:.1f}" for label, value in sorted(row["distances"].items(), key=lambda item: item[1]))
        lines.append(f"| `{row['name']}` | {number(row['fitted_db'])} | {number(row['held_out_db'])} | {number(row['among_db'])} | "
                     f"{number(ratio_of(row), 2)} | {each or 'no recorded set'} |")
    return "\n".join(lines) + "\n"


def beside(row, name, digits=1):
    """`here (lowest to highest of the sets)`, bold where it lies outside."""
    value, real = row["figures"].get(name), row["real"].get(name)
    text = number(value, digits) or "-"
    if real is None or value is None:
        return text
    low, high = real
    outside = value < low - 0.5 * 10 ** -digits or value > high + 0.5 * 10 ** -digits
    return f"{'**' + text + '**' if outside else text} ({number(low, digits)} to {number(high, digits)})"


def colour_table(rows):
    lines = ["| preset | thump (dB) | 5 to 10 kHz, soft (dB) | loud (dB) | centroid, loud over soft | T60 of partials 1-3 (s) | 4-8 (s) | 9-16 (s) |",
             "|---|---|---|---|---|---|---|---|"]
    for row in worst_first(rows):
        cells = [beside(row, "thump_db"), beside(row, "high_soft_db"), beside(row, "high_loud_db"), beside(row, "brightening", 2),
                 *(beside(row, f"t60_{group}_s") for group in ("1-3", "4-8", "9-16"))]
        lines.append(f"| `{row['name']}` | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def coupling_table(rows):
    lines = ["| preset | late over early T60, partials 1-3 | 4-8 | 9-16 | beating, 1-3 (dB) | 4-8 | 9-16 | scatter of T60 (%) | glide, loud (cents) | between the partials (dB) |",
             "|---|---|---|---|---|---|---|---|---|---|"]
    words = [(f"late_over_early_{g}", 2) for g in ("1-3", "4-8", "9-16")] + [(f"beat_db_{g}", 2) for g in ("1-3", "4-8", "9-16")]
    words += [("scatter_percent", 0), ("glide_cents", 1), ("between_db", 0)]
    outside = lambda row: sum("**" in beside(row, *word) for word in words)  # noqa: E731
    for row in sorted(rows, key=lambda r: (-outside(r), not r["real"], r["name"])):
        lines.append(f"| `{row['name']}` | {' | '.join(beside(row, *word) for word in words)} |")
    return "\n".join(lines) + "\n"


def aimed(text, met):
    return text if met else f"**{text}**"


def levels_table(rows):
    middle = sorted(row["figures"]["lufs"] for row in rows)[len(rows) // 2]
    lines = ["| preset | phrase (LUFS) | largest step between keys (dB A) | range (dB A) | left with right | release, 60 dB (s) | after it (dB) |",
             "|---|---|---|---|---|---|---|"]
    for row in sorted(rows, key=lambda r: -r["figures"]["step_db"]):
        f = row["figures"]
        lines.append(f"| `{row['name']}` | {aimed(number(f['lufs']), abs(f['lufs'] - middle) <= LUFS_SPREAD / 2)} | "
                     f"{aimed(number(f['step_db']), f['step_db'] <= STEP_DB)} | {aimed(number(f['range_db']), f['range_db'] <= RANGE_DB)} | "
                     f"{aimed(number(f['correlation'], 2), f['correlation'] <= CORRELATION)} | {beside(row, 'release_s', 2)} | {beside(row, 'release_db')} |")
    return "\n".join(lines) + "\n"


def filled(page, texts):
    for name, text in texts.items():
        page, count = re.subn(rf"<!-- {name} -->\n.*?<!-- /{name} -->", lambda _: f"<!-- {name} -->\n{text}<!-- /{name} -->", page, flags=re.S)
        if count != 1:
            raise ValueError(f"the page has {count} places for {name}")
    return page


def draw(rows, path):
    """Third octaves of each preset that has recorded sets, over theirs: mean over the keys, relative to all."""
    import matplotlib
    matplotlib.use("svg")
    import matplotlib.pyplot as plt
    import numpy as np

    from properties import CENTRES_HZ

    plt.rcParams.update({"font.size": 9, "svg.hashsalt": "jawari", "axes.grid": True, "grid.color": "0.88", "axes.axisbelow": True})
    shown = [row for row in worst_first(rows) if row["distances"]]
    columns = 2
    lines = -(-len(shown) // columns)
    figure, axes = plt.subplots(lines, columns, figsize=(9, 2.3 * lines), sharex=True, sharey=True, squeeze=False)
    for axis in axes.flat[len(shown):]:
        axis.set_visible(False)
    for axis, row in zip(axes.flat, shown):
        for label, spectra in row["spectra"].items():
            near = [levels for key, levels in spectra.items() if label == "preset" or any(abs(key - k) <= 2 for k in row["keys"])]
            if near:
                style = {"color": "#b30000", "linewidth": 2} if label == "preset" else {"color": "0.55", "linewidth": 0.9}
                axis.semilogx(CENTRES_HZ, np.mean(near, axis=0), **style)
        axis.set_title(f"{row['name']}: {row['fitted_db']:.1f} dB", fontsize=9)
        axis.set_ylim(-75, 0)
    for axis in axes[-1]:
        axis.set_xlabel("third octave (Hz)")
    for axis in axes[:, 0]:
        axis.set_ylabel("dB of all")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Date": None}, bbox_inches="tight")
    plt.close(figure)
