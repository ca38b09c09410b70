"""A keyboard plays, a recorder listens: the right notes at the right times, no gap, and the same bits as offline.

JAWARI_LIVE_SECONDS (10 unless set): how long it plays.
"""
import os
import subprocess
import sys
import time

import numpy as np

import live_bench
from live_bench import Bench, Osc

PRESET = "guitar-steel"
KEYS = [40, 47, 52, 45, 57, 50, 59, 64]
NOTE_MS, GAP_MS = 420, 80
FRAMES, RATE_HZ = 256, 48000
ATTEMPTS = 3


def score(seconds):
    """(delay in ms, message): one note after the other, with a controller in between."""
    messages = [(300, (0xB0, 7, 127))]
    count = int(seconds * 1000 / (NOTE_MS + GAP_MS))
    for i in range(count):
        key = KEYS[i % len(KEYS)]
        messages.append((GAP_MS, (0x90, key, 70 + i % 40)))
        messages.append((NOTE_MS, (0x80, key, 64)))
    return messages


def equal_tempered_hz(key):
    return 440 * 2 ** ((key - 69) / 12)


def check_pitch(samples, begin, key):
    import estimate
    expected = equal_tempered_hz(key)
    passage = samples[begin + RATE_HZ // 20:begin + int(0.4 * RATE_HZ)].mean(axis=1)
    found = estimate.measure(passage, expected, expected, RATE_HZ)
    error = estimate.cents(found.frequency_hz, expected)
    assert abs(error) < 8, f"key {key} sounds {error:.1f} cents off"
    return error


def check_times(sent_s, played):
    """Between two messages as many frames as they were sent apart, to within two blocks: the library hands JACK's
    messages over block by block, without their place inside it."""
    frames = np.array([frame for frame, _ in played])
    offsets = frames - np.array(sent_s) * RATE_HZ
    spread = offsets.max() - offsets.min()
    assert spread <= 2 * FRAMES, f"times waver by {spread:.0f} frames"
    return spread


def check_silence_before(samples, played):
    first = next(frame for frame, message in played if message[0] & 0xF0 == 0x90)
    assert not samples[:first].any(), "there is sound before the first note"
    assert samples[first:first + RATE_HZ // 10].any(), "the first note is silent"
    return first


def check_loudspeaker(heard_path, recorded):
    """What went to JACK, taken down by JACK's own recorder, is what the program recorded, a constant delay apart."""
    import soundfile_reader
    heard = soundfile_reader.read_pcm16(heard_path)
    mono = recorded[:, 0]
    start = int(np.argmax(np.abs(mono) > 0.01))
    pattern = mono[start:start + RATE_HZ // 2]
    spectrum = np.fft.irfft(np.fft.rfft(heard, 2 ** 21) * np.conj(np.fft.rfft(pattern, 2 ** 21)))
    shift = int(np.argmax(spectrum[:len(heard)])) - start
    length = min(len(mono) - start, len(heard) - start - shift)
    error = np.abs(heard[start + shift:start + shift + length] - mono[start:start + length]).max()
    assert error < 2.0 / 32768, f"JACK heard something else: {error}"
    return length / RATE_HZ


class Performance:
    """One run: what was sent, said, recorded and heard."""

    def __init__(self, bench, seconds):
        port = live_bench.free_port()
        keyboard = bench.sender()
        wav, self.midi, self.heard = bench.path("take.wav"), bench.path("take.mid"), bench.path("heard.wav")
        player = bench.play("--preset", PRESET, "--fixed-quality", "--audio", "jack", "--midi", "jack", "--midi-in", "keyboard", "--osc-port",
                            str(port), "--record", wav, "--record-midi", self.midi, "--force")
        player.expect_keyboard("keyboard")
        recorder = subprocess.Popen(["jack_rec", "-f", self.heard, "-d", str(int(seconds) + 2), "-b", "16", "jawari:outport 0"],
                                    env=bench.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        bench.children.append(recorder)
        self.messages = score(seconds)
        self.sent_s = keyboard.send(self.messages)
        time.sleep(0.3)  # the last message is still on its way
        self.stats = Osc(port).values("stats")
        recorder.wait(timeout=30)
        assert player.end() == 0, player.err
        assert "recorded" in player.err, player.err
        keyboard.end()
        self.samples, rate_hz = live_bench.read_float_wav(wav)
        assert rate_hz == RATE_HZ
        self.played = live_bench.read_midi_frames(self.midi)

    def check_sound(self, bench):
        """What holds whether or not the machine gave the server its time."""
        assert self.stats["lost_messages"] == 0 and self.stats["messages"] == len(self.messages), self.stats
        assert [m for _, m in self.played] == [m for _, m in self.messages], "other messages were played than sent"
        first = check_silence_before(self.samples, self.played)
        errors = [check_pitch(self.samples, frame, message[1]) for frame, message in self.played if message[0] & 0xF0 == 0x90]
        again, again_stats = live_bench.render_again(bench, self.midi, PRESET, RATE_HZ)
        assert again_stats["notes"] == len(errors)
        assert len(again) >= len(self.samples) - RATE_HZ // 2
        assert live_bench.stereo_equal(self.samples, again), "rendered offline, the recorded MIDI sounds different"
        again[first + 1000, 0] += 1e-7
        assert not live_bench.stereo_equal(self.samples, again), "the comparison sees nothing"
        print(f"{len(errors)} notes, pitch within {max(map(abs, errors)):.2f} cents, {len(self.samples)} frames equal to "
              f"jawari render of the recorded MIDI, bit for bit")

    def check_clock(self, bench):
        """What needs a server without gaps."""
        spread = check_times(self.sent_s, self.played)
        heard_s = check_loudspeaker(self.heard, self.samples)
        print(f"no xruns; times within {spread:.0f} frames, {heard_s:.1f} s heard through JACK as recorded; worst block "
              f"{100 * self.stats['worst_load']:.0f} % of {1000 * FRAMES / RATE_HZ:.1f} ms")


def gaps_without_the_program(bench, seconds):
    """Times in which the server did not get its clients' work in time, with two clients that do next to nothing."""
    log = bench.folder / "jackd.log"
    before = log.read_text().count("XRun")
    idle = [bench.sender("idle-a"), bench.sender("idle-b")]
    time.sleep(seconds)
    for each in idle:
        each.end()
    return log.read_text().count("XRun") - before


def main(program, sender_program):
    seconds = float(os.environ.get("JAWARI_LIVE_SECONDS", "10"))
    with Bench("e2e", program, sender_program, RATE_HZ, FRAMES) as bench:
        gaps = []
        for _ in range(ATTEMPTS):
            performance = Performance(bench, seconds)
            performance.check_sound(bench)
            if performance.stats["xruns"] == 0:
                performance.check_clock(bench)
                return
            gaps.append(int(performance.stats["xruns"]))
            print(f"{gaps[-1]} xruns, worst block {100 * performance.stats['worst_load']:.0f} % of its time; once more")
        others = gaps_without_the_program(bench, seconds * ATTEMPTS)
        assert others > 0, f"{gaps} xruns in {ATTEMPTS} runs of {seconds} s, and none without the program"
        print(f"xruns not judged: this machine has {others} in {seconds * ATTEMPTS:.0f} s without the program as well")


if __name__ == "__main__":
    main(*sys.argv[1:])
