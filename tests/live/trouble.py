"""What goes wrong on a stage: the server dies, a keyboard is pulled out, the program is killed, a device has another name."""
import os
import signal
import sys
import time

import numpy as np

import live_bench
from live_bench import Bench


def note(key, velocity=100):
    return (0x90, key, velocity)


def lost_server(bench):
    player = bench.play("--preset", "bass-fretted", "--midi", "jack")
    player.expect("real-time priority")
    bench.stop_server(signal.SIGKILL)
    player.expect('audio: jack: "system" is lost; looking for it every second')
    time.sleep(1.5)
    assert player.process.poll() is None, "the program went with its server"
    bench.start_server()
    player.expect("midi: jack: virtual port")
    deadline = time.monotonic() + live_bench.PATIENCE_S
    while player.err.count('audio: jack: "system", 48000 Hz') < 2:
        assert time.monotonic() < deadline, player.err
        time.sleep(0.1)
    keyboard = bench.sender()
    player.expect_keyboard("keyboard")
    assert player.end() == 0, player.err
    keyboard.end()

    player = bench.play("--no-retry")
    player.expect("real-time priority")
    bench.stop_server(signal.SIGKILL)
    assert player.end(how=None) == 6, player.err
    assert player.err.strip().endswith('audio: jack: "system" is lost'), player.err
    bench.start_server()
    print("server: loss reported, found again with its keyboard; --no-retry ends with code 6")


def other_rate(bench):
    """The server comes back with another rate: the instrument is made for it."""
    player = bench.play("--preset", "bass-fretted")
    player.expect("real-time priority")
    bench.stop_server(signal.SIGKILL)
    bench.rate_hz = 44100
    bench.start_server()
    player.expect("the device runs at 44100 Hz, not at 48000; so does the instrument")
    player.expect("virtual port")
    assert player.end() == 0, player.err
    bench.stop_server()
    bench.rate_hz = 48000
    bench.start_server()
    print("another rate is told and followed")


def unplugged_keyboard(bench):
    wav, midi = bench.path("unplugged.wav"), bench.path("unplugged.mid")
    player = bench.play("--preset", "bass-fretted", "--midi", "jack", "--monitor", "--record", wav, "--record-midi",
                        midi)
    keyboard = bench.sender()
    player.expect_keyboard("keyboard")
    keyboard.send([(0, (0xB0, 64, 127)), (10, note(40)), (10, note(47)), (10, (0x80, 47, 64))])
    player.expect("note off    B2   (47)  velocity 64")
    keyboard.unplug()
    player.expect("is gone; its notes are released")
    keyboard.plug()
    player.expect_keyboard("keyboard", times=2)
    keyboard.send([(0, note(52))])
    player.expect("note on     E3   (52)  velocity 100")
    assert player.end() == 0, player.err
    keyboard.end()
    played = [message for _, message in live_bench.read_midi_frames(midi)]
    assert played[:4] == [(0xB0, 64, 127), note(40), note(47), (0x80, 47, 64)], played
    assert sorted(played[4:6]) == [(0x80, 40, 64), (0xB0, 64, 0)], f"what was held is let go, and nothing else: {played}"
    assert played[6] == note(52), played
    print("keyboard: pulled out, its note and pedal let go, plugged in again")


def cut_connections(bench):
    """A cable is pulled while both ports stay, or a program patched to the virtual port ends: what it held is let go."""
    midi = bench.path("cut.mid")
    player = bench.play("--preset", "bass-fretted", "--midi", "jack", "--midi-in", "virtual", "--monitor", "--record-midi", midi)
    player.expect("real-time priority")
    held = [(10, (0xB0, 64, 127)), (10, (0xE0, 0, 96)), (10, note(40)), (10, note(47)), (10, (0x80, 47, 64))]
    ways = {"cut": lambda keyboard: bench.tool("jack_disconnect", "keyboard:out", "jawari-midi:in"),
            "ended": lambda keyboard: keyboard.end(),
            "killed": lambda keyboard: keyboard.process.kill()}
    cuts = 0
    for times, (way, go) in enumerate(ways.items(), start=1):
        keyboard = bench.sender()
        connected = bench.tool("jack_connect", "keyboard:out", "jawari-midi:in")
        assert connected.returncode == 0, connected
        time.sleep(0.3)
        keyboard.send(held)
        player.expect_times("note off    B2   (47)  velocity 64", times)
        time.sleep(0.1)
        go(keyboard)
        cuts += 1
        player.expect_times("to jawari-midi:in was cut; its notes are released", cuts)
        if way == "cut":
            assert 'the connection of "keyboard:out" to jawari-midi:in was cut' in player.err, player.err
            assert bench.tool("jack_connect", "keyboard:out", "jawari-midi:in").returncode == 0
            time.sleep(0.3)
            keyboard.send([(0, note(52)), (10, (0x80, 52, 64))])
            player.expect("note on     E3   (52)  velocity 100")
            assert bench.tool("jack_disconnect", "keyboard:out", "jawari-midi:in").returncode == 0
            cuts += 1
            player.expect_times("to jawari-midi:in was cut; its notes are released", cuts)
            keyboard.end()
    time.sleep(0.3)  # the last block
    assert player.end() == 0, player.err
    played = [message for _, message in live_bench.read_midi_frames(midi, bends=True)]
    released = {(0x80, 40, 64), (0xB0, 64, 0), (0xE0, 0, 64)}
    sent = [message for _, message in held]
    expected = [*sent, released, note(52), (0x80, 52, 64), *sent, released, *sent, released]
    at = 0
    for part in expected:
        if isinstance(part, set):
            assert set(played[at:at + 3]) == part, f"what was held is let go, and nothing else: {played}"
            at += 3
        else:
            assert played[at] == part, f"{at}: {played}"
            at += 1
    assert at == len(played), played

    player = bench.play("--preset", "bass-fretted", "--midi", "jack", "--monitor")
    keyboard = bench.sender()
    player.expect_keyboard("keyboard")
    inputs = [line.strip() for line in bench.tool("jack_lsp", "-c", "keyboard:out").stdout.splitlines()[1:]]
    assert len(inputs) == 1, inputs
    keyboard.send([(0, note(40))])
    player.expect("note on     E2   (40)")
    assert bench.tool("jack_disconnect", "keyboard:out", inputs[0]).returncode == 0
    player.expect(f'the connection of "keyboard:out" to {inputs[0]} was cut; its notes are released')
    keyboard.end()
    player.expect('"keyboard:out" is gone; its notes are released')
    assert player.err.count("was cut") == 1, player.err
    assert player.end() == 0, player.err
    print("connections: cut, or ended with their program; note, pedal and bend let go")


def ended(bench):
    """A recording is whole after SIGTERM, and after SIGKILL up to its last second."""
    for how, code in ((signal.SIGTERM, 0), (signal.SIGINT, 0), (signal.SIGHUP, 0), (signal.SIGKILL, -9)):
        wav, midi = bench.path(f"{code}{how}.wav"), bench.path(f"{code}{how}.mid")
        player = bench.play("--preset", "bass-fretted", "--midi", "jack", "--record", wav, "--record-midi", midi)
        keyboard = bench.sender()
        player.expect_keyboard("keyboard")
        keyboard.send([(0, note(40)), (500, (0x80, 40, 64))] * 6)
        time.sleep(0.1)  # the last message is still on its way
        began = time.monotonic()
        assert player.end(how) == code, player.err
        samples, rate_hz = live_bench.read_float_wav(wav)
        played = live_bench.read_midi_frames(midi)
        seconds = len(samples) / rate_hz
        missing = 0.3 if code == 0 else 1.5  # a busy machine loses blocks, which are not in the recording
        assert seconds >= 3 - missing, f"{how!r}: {seconds} s are left"
        assert len(played) >= (12 if code == 0 else 8), f"{how!r}: {len(played)} messages are left"
        assert np.abs(samples).max() > 0.01
        assert time.monotonic() - began < 5
        keyboard.end()
        if code == 0:
            assert "recorded" in player.err, player.err
    existing = bench.run("play", "--no-shell", "--record", wav)
    assert existing.returncode == 4 and os.path.basename(wav) in existing.stderr, existing
    print("signals: SIGTERM, SIGINT and SIGHUP leave whole files, SIGKILL all but the last second; nothing is overwritten")


def unknown_devices(bench):
    cases = [(["--audio", "jack", "--audio-device", "nothing"], 'no audio device has that number or name (0 "system")'),
             (["--audio", "jack", "--audio-device", "7"], "no audio device has that number or name"),
             (["--midi", "jack", "--midi-in", "nothing"], "no MIDI input has that number or name"),
             (["--audio", "alsa"], "audio: alsa: no device"),
             (["--midi", "alsa"], "midi: alsa:")]
    a, b = bench.sender("twin-a"), bench.sender("twin-b")
    cases.append((["--midi", "jack", "--midi-in", "TWIN"], "more than one MIDI input"))
    for arguments, text in cases:
        if "alsa" in arguments and os.path.exists("/dev/snd"):
            continue
        ran = bench.run("play", "--no-shell", *arguments)
        assert ran.returncode == 6 and text in ran.stderr, f"{arguments}: {ran}"
        errors = [line for line in ran.stderr.splitlines() if not line.startswith(('audio: jack: "system", ', "preset: "))]
        assert len(errors) == 1, f"{arguments}: {ran.stderr}"
    player = bench.play("--midi", "jack", "--midi-in", "TWIN-B", "--audio-device", "SYS")
    player.expect_keyboard("twin-b")
    assert "twin-a" not in player.err
    player.end()
    listing = bench.run("devices")
    assert "0  system, 2 channels, 48000 Hz, default" in listing.stdout and "twin-a" in listing.stdout, listing
    a.end()
    b.end()
    print("devices: unknown and ambiguous names get one line that lists what is there, and code 6")


def main(program, sender_program):
    with Bench("trouble", program, sender_program) as bench:
        unknown_devices(bench)
        unplugged_keyboard(bench)
        cut_connections(bench)
        ended(bench)
        lost_server(bench)
        other_rate(bench)


if __name__ == "__main__":
    main(*sys.argv[1:])
