"""What playing is started with: tuning, MIDI map, bend range, guitar mode; and the presets that program changes ask for."""
import json
import sys
import time

import numpy as np

import live_bench
import estimate  # of tests/presets, where live_bench finds it
from live_bench import Bench


def frequencies_of(wav, about_hz):
    """First partials of notes that begin 1.2 s apart."""
    samples, rate_hz = live_bench.read_float_wav(wav)
    mono = samples.mean(axis=1)
    begin_s = np.flatnonzero(np.abs(mono) > 0.05 * np.abs(mono).max())[0] / rate_hz + 0.1
    passages = [mono[int((begin_s + 1.2 * n) * rate_hz):int((begin_s + 1.2 * n + 0.7) * rate_hz)] for n in range(len(about_hz))]
    return [estimate.measure(passage, near_hz, near_hz, rate_hz).frequency_hz for passage, near_hz in zip(passages, about_hz)]


def an_octave_of(bench, *arguments):
    """Cents between A2 and A3, as the recording has them."""
    wav = bench.path("tuned.wav")
    player = bench.play("--preset", "guitar-nylon", "--record", wav, "--force", *arguments, commands=True)
    player.expect("preset: guitar-nylon")
    for line in ["wait 0.2", "note A2 90 0.9", "wait 1.2", "note A3 90 0.9", "wait 1.2"]:
        player.command(line)
    player.process.stdin.close()
    assert player.end(how=None) == 0, player.err
    low, high = frequencies_of(wav, (110, 220))
    return estimate.cents(high, low)


def tuned(bench):
    scale = bench.path("wide.scl")
    with open(scale, "w", encoding="utf-8") as file:
        file.write("wide semitones\n12\n" + "".join(f"{104 * degree}.0\n" for degree in range(1, 13)))
    plain, wide = an_octave_of(bench), an_octave_of(bench, "--tuning", scale)
    assert abs(plain - 1200) < 2, plain
    assert abs(wide - 1248) < 2, wide
    with open(scale, "w", encoding="utf-8") as file:
        file.write("x\n1\n0/1\n")
    ran = bench.run("play", "--tuning", scale)
    assert ran.returncode == 3 and 'wide.scl: line 3: "0/1"' in ran.stderr and ran.stderr.count("(allowed:") == 1, ran
    print(f"tuning: an octave of {plain:.2f} cents, and with wide semitones of {wide:.2f}")


def mapped(bench):
    table = bench.path("map.json")
    with open(table, "w", encoding="utf-8") as file:
        json.dump({"schema": "jawari.midi-map/1",
                   "bindings": [{"controller": 20, "parameter": "pan", "from": -0.5, "to": 0.5, "curve": "linear"}]}, file)
    player = bench.play("--preset", "guitar-nylon", "--midi", "jack", "--midi-map", table, commands=True)
    keyboard = bench.sender()
    player.expect_keyboard("keyboard")
    keyboard.send([(0, (0xB0, 20, 127))])
    deadline = time.monotonic() + live_bench.PATIENCE_S
    while "pan = 0.5" not in player.out:
        assert time.monotonic() < deadline, player.out + player.err
        player.command("get pan")
        time.sleep(0.1)
    player.end()
    keyboard.end()
    print("MIDI map: the controller turns its parameter")


def bent(bench):
    wav = bench.path("bent.wav")
    player = bench.play("--preset", "guitar-nylon", "--midi", "jack", "--set", "bend_range=5", "--record", wav, commands=True)
    keyboard = bench.sender()
    player.expect_keyboard("keyboard")
    player.command("set bend_range 2")
    player.expect("bend_range: set by RPN 0, or --set when jawari play starts")
    keyboard.send([(0, (0xE0, 127, 127)), (100, (0x90, 45, 90)), (1200, (0x80, 45, 64))])
    time.sleep(1.6)
    player.end()
    keyboard.end()
    frequency_hz, = frequencies_of(wav, (110 * 2**(5 / 12),))
    cents = estimate.cents(frequency_hz, 110)
    assert abs(cents - 500) < 2, cents
    print(f"bend range: the wheel's end is {cents:.2f} cents up")


def guitar(bench):
    player = bench.play("--preset", "guitar-nylon", "--guitar-mode", "1", commands=True)
    player.expect("preset: guitar-nylon")
    player.command("preset bass-fretted")
    player.expect("guitar mode: the strings are others; start jawari play with this preset")
    player.command("stats")
    player.expect("load ", "out")
    player.end()
    ran = bench.run("play", "--preset", "bass-fretted", "--guitar-mode", "14")
    assert ran.returncode == 2 and "14 (allowed: 1 to 13" in ran.stderr and ran.stderr.count("(allowed:") == 1, ran
    print("guitar mode: a preset with other strings is refused, and playing goes on")


def programs(bench):
    player = bench.play("--midi", "jack")
    keyboard = bench.sender()
    player.expect_keyboard("keyboard")
    keyboard.send([(0, (0xC9, 33)), (50, (0xC0, 24))])  # what channel 10 asks for is drums
    player.expect("preset: guitar-nylon")
    assert "preset: bass-fretted" not in player.err, player.err
    keyboard.send([(0, (0xC0, 33))])
    player.expect("preset: bass-fretted")
    player.end()

    player = bench.play("--midi", "jack", "--preset", "sitar")
    player.expect_keyboard("keyboard")
    keyboard.send([(0, (0xC0, 24)), (50, (0x90, 60, 90))])
    time.sleep(1)
    assert player.end() == 0, player.err
    assert "preset: guitar-nylon" not in player.err, "a preset that was asked for stays"
    keyboard.end()
    print("program changes: followed unless a preset was asked for, channel 10 left alone")


def main(program, sender_program):
    with Bench("settings", program, sender_program) as bench:
        tuned(bench)
        mapped(bench)
        bent(bench)
        guitar(bench)
        programs(bench)


if __name__ == "__main__":
    main(*sys.argv[1:])
