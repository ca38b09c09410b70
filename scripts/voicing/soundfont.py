"""The recordings inside a SoundFont 2 file: what lies before each sample's loop, unprocessed (SoundFont Technical Specification 2.04)."""
import struct

import numpy as np

KEY_RANGE, INSTRUMENT, SAMPLE, ROOT_KEY = 43, 41, 53, 58  # generators (8.1.2)
ROM = 0x8000


def chunks(data, begin, end):
    """(name, begin, end) of each chunk; of a LIST its kind and what is inside."""
    while begin + 8 <= end:
        name, size = data[begin:begin + 4], struct.unpack_from("<I", data, begin + 4)[0]
        yield name, begin + 8, begin + 8 + size
        if name in (b"RIFF", b"LIST"):
            yield from chunks(data, begin + 12, begin + 8 + size)
        begin += 8 + size + (size & 1)


class SoundFont:
    def __init__(self, path):
        self.data = memoryview(path.read_bytes())
        self.places = {bytes(name): (begin, end) for name, begin, end in chunks(self.data, 0, len(self.data))}
        if b"smpl" not in self.places or b"shdr" not in self.places:
            raise ValueError(f"{path}: no SoundFont 2 file with samples")

    def records(self, name, layout):
        begin, end = self.places[name]
        return [struct.unpack_from(layout, self.data, at) for at in range(begin, end, struct.calcsize(layout))]

    def zones(self, bags, generators, first, last):
        """Generators of each zone, as a dictionary of raw amounts."""
        for zone in range(first, last):
            yield {kind: amount for kind, amount in generators[bags[zone][0]:bags[zone + 1][0]]}

    def samples_of(self, program, bank):
        """(sample header, root key, lowest key, highest key) of every zone of a preset."""
        presets = self.records(b"phdr", "<20s3H3I")
        bags, generators = self.records(b"pbag", "<2H"), self.records(b"pgen", "<2H")
        instruments = self.records(b"inst", "<20sH")
        inner_bags, inner = self.records(b"ibag", "<2H"), self.records(b"igen", "<2H")
        headers = self.records(b"shdr", "<20s5IBbHH")
        for this, following in zip(presets, presets[1:]):
            if (this[1], this[2]) != (program, bank):
                continue
            for zone in self.zones(bags, generators, this[3], following[3]):
                if INSTRUMENT not in zone:
                    continue
                first, last = instruments[zone[INSTRUMENT]][1], instruments[zone[INSTRUMENT] + 1][1]
                for part in self.zones(inner_bags, inner, first, last):
                    if SAMPLE in part:
                        header = headers[part[SAMPLE]]
                        keys = part.get(KEY_RANGE, 127 << 8)
                        yield header, part.get(ROOT_KEY, header[6]), keys & 255, keys >> 8

    def heads(self, program, bank=0):
        """The recordings of a preset up to their loops, each once: (root key, correction in cents, rate in Hz, samples)."""
        begin, _ = self.places[b"smpl"]
        seen = set()
        for header, root, _, _ in self.samples_of(program, bank):
            _, start, end, loop, _, rate, _, cents, _, kind = header
            if kind & ROM or start in seen:
                continue
            seen.add(start)
            last = loop if start < loop < end else end
            yield root, cents, rate, np.frombuffer(self.data[begin + 2 * start:begin + 2 * last], "<i2") / 32768.0
