"""Commands through a pipe and as OSC messages; whatever else comes over the network."""
import json
import random
import sys
import time

import live_bench
from live_bench import Bench, Osc


def through_a_pipe(bench):
    wav = bench.path("piped.wav")
    player = bench.play("--preset", "bass-fretted", commands=True)
    player.expect("preset: bass-fretted")
    for line in ["# a comment", "", f'record start "{wav}"', "note E1 100 0.5", "wait 0.7", "set pan -1", "get pan", "gain -6",
                 "stats", "bogus", "set volume 7", "set nothing 1", "note 200 1 1", "record start x.ogg", "preset no-such",
                 "presets", "monitor on", "note 40 90 0.2", "wait 0.4", "panic", "devices", "help note", "record stop",
                 "record stop", f'record start "{wav}"', 'get "open', "gain 100", "wait -1", "note E1 100 1e9", "record start",
                 "record start a.wav b.wav", "record stop a.wav"]:
        player.command(line)
    player.process.stdin.close()  # the end of the commands is the end of the program
    code = player.end(how=None)
    assert code == 0, player.err
    for text in ["pan = -1", "load ", "energy", "note KEY VELOCITY SECONDS", "guitar-nylon", "audio jack:", "recorded "]:
        assert text in player.out, f"no '{text}' in\n{player.out}"
    for text in ['command: "bogus" (allowed: preset,', "set volume: 7 (allowed: 0 to 1)", 'set: "nothing" (allowed: volume,',
                 'note: KEY: "200" (allowed: a key', 'record start: "x.ogg"', "no-such: no such file, and no preset",
                 "note on     E2", "nothing is being recorded", "a double quote is left open", "piped.wav",
                 "gain: 100 (allowed: -120 to 60 dB)", "wait: -1 (allowed: 0 to 3600 seconds)",
                 "note: SECONDS: 1000000000 (allowed: above 0, to 600)", "record start: no file (allowed: FILE.wav, FILE.mid or both)",
                 "one .wav and one .mid at most", 'record stop: "a.wav" (allowed: no file)']:
        assert text in player.err, f"no '{text}' in\n{player.err}"
    samples, _ = live_bench.read_float_wav(wav)
    assert abs(samples).max() > 0.01, "the recording is silent"
    print("pipe: every command answered, the recording has sound")


def over_the_network(bench):
    port = live_bench.free_port()
    player = bench.play("--osc-port", str(port), "--preset", "bass-fretted")
    player.expect("preset: bass-fretted")
    osc = Osc(port)
    assert osc.ask("set", "pan", 0.5) == [("/jawari/reply", ["set", "ok"])]
    time.sleep(0.1)
    assert osc.values("get", "pan") == {"pan": 0.5}
    assert osc.ask("note", 40, 100, 0.3) == [("/jawari/reply", ["note", "ok"])]
    time.sleep(0.15)
    assert osc.values("stats")["notes"] == 1
    assert osc.ask("preset", "sitar") == [("/jawari/reply", ["preset", "ok"])]
    path, words = osc.ask("preset", "no-such")[0]
    assert path == "/jawari/error" and words[0] == "preset" and "no preset of that name" in words[1], words
    for verb, *arguments in [("set", "pan", 2.0), ("set", "pan"), ("note", "x", 1, 1), ("nothing",), ("wait", 1.0),
                             ("gain", float("nan")), ("preset", "../sitar.json"),
                             ("note", 60, 100, float("inf")), ("monitor", 2), ("record", "stop")]:
        path, words = osc.ask(verb, *arguments)[0]
        assert path == "/jawari/error", f"{verb} {arguments}: {path} {words}"
    assert osc.ask("monitor", True) == [("/jawari/reply", ["monitor", "ok"])]

    bundle = b"#bundle\0" + bytes(8)
    for packet in (Osc.packet("/jawari/set", "pan", -0.25), Osc.packet("/jawari/set", "volume", 0.5)):
        bundle += len(packet).to_bytes(4, "big") + packet
    osc.socket.send(bundle)
    assert [osc.receive() for _ in range(2)] == [("/jawari/reply", ["set", "ok"])] * 2

    other = Osc(port)
    dice = random.Random(5)
    good = Osc.packet("/jawari/get", "pan")
    for _ in range(3000):
        packet = bytearray(dice.choice([good, bundle, dice.randbytes(dice.randrange(64) * 4)]))
        for _ in range(dice.randrange(6)):
            if packet:
                packet[dice.randrange(len(packet))] = dice.randrange(256)
        if b"quit" not in packet:
            other.socket.send(bytes(packet[:dice.randrange(len(packet) + 1)] if dice.random() < 0.3 else packet))
    time.sleep(0.5)
    assert player.process.poll() is None, "garbage ended the program"
    # What garbage has changed is known to nobody; that it still answers counts.
    assert osc.ask("set", "pan", 0.125) == [("/jawari/reply", ["set", "ok"])]
    osc.send("/jawari/quit")
    assert player.end(how=None) == 0, player.err
    print("OSC: typed arguments, answers, errors, bundles; 3000 packets of garbage change nothing")


def ignored(bench):
    """What a keyboard sends and strings cannot do is counted by kind."""
    player = bench.play("--preset", "bass-fretted", "--midi", "jack", "--osc-port", str(port := live_bench.free_port()), commands=True)
    keyboard = bench.sender()
    player.expect_keyboard("keyboard")
    keyboard.send([(0, (0xB0, 91, 5)), (1, (0xB3, 91, 6)), (1, (0xB0, 7, 100)),
                   (1, (0xF0, 0x41, 0x10, 0x42, 0x12, 0x40, 0x01, 0x30, 0x04, 0x0B, 0xF7))])
    time.sleep(0.5)
    player.command("stats")
    player.expect("ignored: 2 controller 91 (reverb)", "out")
    player.expect("ignored: 1 system exclusive: GS reverb", "out")
    assert Osc(port).values("stats")["ignored_messages"] == 3
    assert player.end() == 0, player.err
    keyboard.end()
    print("statistics: ignored messages by kind")


def refused(bench):
    port = live_bench.free_port()
    player = bench.play("--osc-port", str(port))
    player.expect("preset: ")
    second = bench.run("play", "--no-shell", "--osc-port", str(port))
    assert second.returncode == 6 and second.stderr.count("\n") == 1 and "Address already in use" in second.stderr, second
    player.end()
    for arguments, code, text in [
            (["--osc-host", "nowhere", "--osc-port", str(port)], 2, "--osc-host"),
            (["--frames", "8"], 2, "16 to 8192"),
            (["--move-frets"], 2, "--move-frets: given (allowed: only with --tuning)"),
            (["--audio", "tape"], 2, "--audio"),
            (["--keyboard-map", "x.kbm"], 2, "only with --tuning"),
            (["--guitar-mode", "1"], 2, "only with --preset"),
            (["--preset", "no-such"], 4, "no preset of that name"),
            (["--config", bench.path("none.json")], 4, "none.json"),
            (["--midi-map", bench.path("none.json")], 4, "none.json")]:
        ran = bench.run("play", *arguments)
        assert ran.returncode == code and text in ran.stderr, f"{arguments}: {ran}"
    config = bench.folder / "jawari"
    config.mkdir()
    (config / "play.json").write_text('{"schema": "jawari.play-config/1", "preset": "sitar", "frames": 4}')
    ran = bench.run("play")
    assert ran.returncode == 3 and "play.json: frames: 4 (allowed: a whole number from 16 to 8192)" in ran.stderr, ran
    (config / "play.json").write_text('{"schema": "jawari.play-config/1", "preset": "sitar", "parameters": {"pan": 1}}')
    player = bench.play(commands=True)
    player.command("get pan")
    player.expect("pan = 1", "out")
    player.end()
    assert "preset: sitar" in player.err
    player = bench.play("--preset", "biwa")
    player.expect("preset: biwa")
    player.end()
    print("refusals: one line and a code each; configuration below the command line")


def devices_as_json(bench):
    ran = bench.run("devices", "--json")
    assert ran.returncode == 0, ran
    devices = json.loads(ran.stdout)
    assert devices["schema"] == "jawari.devices/1"
    servers = {each["system"]: each for each in devices["audio"]}
    sound, = servers["jack"]["devices"]
    assert sound["output_channels"] >= 2 and sound["preferred_rate_hz"] in sound["rates_hz"], sound
    assert all("problem" in each or each["devices"] for each in devices["audio"]), devices
    assert all({"system", "inputs"} <= each.keys() for each in devices["midi"]), devices
    print("devices: the server's, as JSON")


def main(program, sender_program):
    with Bench("commands", program, sender_program) as bench:
        through_a_pipe(bench)
        over_the_network(bench)
        ignored(bench)
        refused(bench)
        devices_as_json(bench)


if __name__ == "__main__":
    main(*sys.argv[1:])
