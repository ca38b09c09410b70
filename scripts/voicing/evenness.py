"""Evens the level of the keys of an instrument with a body: which mode makes which key loud, and by how much each has to change.

The A-weighted power of a key is the sum over its spectrum; at each frequency the modes share it by their power response. So a change of x_j dB of mode j
changes key k by about sum_j w_kj x_j, w_kj its share of the key's power, and the x that even the keys are a ridge regression.
"""
import numpy as np
import properties

BIN_HZ = 5.0
HIGHEST_HZ = 6000.0
LARGEST_DB = 6.0        # no mode is moved by more
RIDGE = 0.02            # of a change of one mode by a decibel against an error of a key by one
KEY_DB, STEP_DB = 4.0, 3.0  # what a key may be off the median, and a step between neighbours


def a_weighted_bins(sound, rate_hz):
    """A-weighted power of the first half second in bins of BIN_HZ."""
    windowed = properties.falling(sound, properties.SPECTRUM_S, rate_hz)
    frequency, power = properties.power_spectrum(windowed, rate_hz)
    power = power * properties.a_weighting(frequency)
    return np.bincount((frequency[frequency < HIGHEST_HZ] / BIN_HZ).astype(int), power[frequency < HIGHEST_HZ], int(HIGHEST_HZ / BIN_HZ))


def shares(body, keys_power):
    """w_kj: of the power of each key (rows) that each mode (columns) radiates. body: rows of a preset's table."""
    f = BIN_HZ * (np.arange(keys_power.shape[1]) + 0.5)
    modes = np.array([[m["frequency_hz"], np.log(1000) / m["t60_s"], m["gain_left"] ** 2 + m["gain_right"] ** 2, m.get("mass_kg", 1.0)] for m in body])
    centre, rate, gain, mass = (column[:, None] for column in modes.T)
    response = gain / mass ** 2 * f ** 2 / ((centre ** 2 - f ** 2) ** 2 + (f * rate / np.pi) ** 2)
    response /= response.sum(axis=0)
    return (keys_power @ response.T) / keys_power.sum(axis=1, keepdims=True)


def changes_db(weights, levels_db, before_db):
    """What each mode has to change by [dB], so that all keys have the median level and neighbours are near; with what was changed before
    no more than LARGEST_DB. Keys and steps count by the square of how far they are off: the largest are to fall."""
    lacks, steps = np.median(levels_db) - levels_db, -np.diff(levels_db)
    of_key, of_step = (lacks / KEY_DB) ** 2, (steps / STEP_DB) ** 2
    matrix = np.concatenate([of_key[:, None] * weights, of_step[:, None] * np.diff(weights, axis=0), np.sqrt(RIDGE) * np.eye(weights.shape[1])])
    target = np.concatenate([of_key * lacks, of_step * steps, -np.sqrt(RIDGE) * np.asarray(before_db)])
    found, *_ = np.linalg.lstsq(matrix, target, rcond=None)
    return np.clip(np.asarray(before_db) + found, -LARGEST_DB, LARGEST_DB) - before_db


def without_colour(changes, frequencies_hz):
    """The changes less their mean over a third octave, under a Gaussian: keys are evened, the colour of all of them stays."""
    place = np.log2(np.asarray(frequencies_hz))
    near = np.exp(-0.5 * ((place[:, None] - place) * 3) ** 2)
    return changes - near @ changes / near.sum(axis=1)
