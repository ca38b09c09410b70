"""The first channel of a PCM WAV file of 16 bits, as the standard library reads it."""
import wave

import numpy as np


def read_pcm16(path):
    with wave.open(path) as file:
        assert file.getsampwidth() == 2
        data = np.frombuffer(file.readframes(file.getnframes()), "<i2")
        return data.reshape(-1, file.getnchannels())[:, 0] / 32768.0
