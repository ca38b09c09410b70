"""Sections of a preset, with where each value comes from."""

EAR = "chosen: an estimate, not measured"
NOT_SOURCED = {"name", "kind", "origin", "side", "strings", "string_range", "course", "quantity", "damps", "provenance", "comment", "points",
               "open_note"}


def sourced(section, default=EAR, **given):
    """The section with a provenance for every value: those given, the default for the rest."""
    assert set(given) <= set(section), set(given) - set(section)
    origins = {key: given.get(key, default) for key in section if key in given or key not in NOT_SOURCED}
    shared = {}  # keys of one origin are gathered only for reading: the file needs each
    shared.update(origins)
    return {**section, "provenance": shared}


def finger(name, place, width_m, rise_s, release_s, full_height_m, height_exponent, damping_kg_per_s, default=EAR, given=None, **more):
    return sourced({"name": name, "kind": "finger", **place, "width_m": width_m, "rise_s": rise_s, "release_s": release_s,
                    "full_height_m": full_height_m, "height_exponent": height_exponent, "damping_kg_per_s": damping_kg_per_s, **more},
                   default, **(given or {}))


# Soft notes are let go more slowly: a finger that pulls less slips off less sharply. Twice as long at a quarter of the velocity.
SOFTER = {"time_exponent": 0.5}
# A plectrum bends less.
SOFTER_PLECTRUM = {"time_exponent": 0.2}


def rough(share):
    """Noise of the attack: of the force, as rms."""
    return {"roughness": share}


def noise(force_n, time_s):
    """Noise of the release: rms force on the string in its middle, and how long it takes."""
    return {"release_noise_N": force_n, "release_noise_s": time_s}


def hammer(name, place, width_m, mass_kg, stiffness, exponent, loss_s_per_m, full_speed_m_per_s, speed_exponent, default=EAR, given=None,
           **more):
    return sourced({"name": name, "kind": "hammer", **place, "width_m": width_m, "mass_kg": mass_kg, "stiffness_N_per_m_p": stiffness,
                    "exponent": exponent, "loss_s_per_m": loss_s_per_m, "full_speed_m_per_s": full_speed_m_per_s,
                    "speed_exponent": speed_exponent, **more}, default, **(given or {}))


def from_bridge(distance_m):
    return {"position_from_bridge_m": distance_m}


def share(of_length):
    """From the bridge."""
    return {"position_share": of_length}


def hand(release_t60_s, places=(0.137, 0.31), palm_m=0.03, **more):
    return sourced({"release_places": [share(places[0]), share(places[1])], "release_t60_s": release_t60_s, "palm_place": from_bridge(palm_m),
                    **more})


def velocity_pickup(from_bridge_m, width_m, level, where, **more):
    given = {"position_from_bridge_m": "chosen: " + where}
    if "magnet_distance_m" in more:
        given["magnet_distance_m"] = "chosen distance for a published law (Horton and Moore, Am. J. Phys. 77 (2009) 144)"
    return sourced({"quantity": "velocity", **from_bridge(from_bridge_m), "width_m": width_m, "level": level, **more}, **given)


def quality(contact_rate_min_hz, mode_limit_hz):
    return {"contact_rate_min_hz": contact_rate_min_hz, "mode_limit_hz": mode_limit_hz}


def panned(rows, width):
    """From left to right in the order of the list."""
    return [{**row, "pan": round(width * (2 * i / (len(rows) - 1) - 1), 3)} for i, row in enumerate(rows)]


def with_sources(rows, **origins):
    """Each string with its own provenance; an origin may be a list with one text per string."""
    return [sourced(row, **{key: (text[i] if isinstance(text, list) else text) for key, text in origins.items() if key in row})
            for i, row in enumerate(rows)]
