// The whole loop, measured by JACK's own clock: sends notes on its MIDI port and listens on its audio port
// for the first sample that is not zero. Prints the frames between the two, a line a note. Before each note
// all sound is turned off, so that there is silence to begin with.
#include <jack/jack.h>
#include <jack/midiport.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

namespace {

constexpr std::size_t most_notes = 1000;
constexpr std::int64_t silence_frames = 12000;  // between the end of a note and the next one
constexpr std::int64_t patience_frames = 48000;

struct Probe {
    jack_port_t* midi = nullptr;
    jack_port_t* audio = nullptr;
    std::size_t wanted = 0;
    std::atomic<std::size_t> measured{0};
    std::array<std::int64_t, most_notes> delay{};
    // Of the process thread, in frames since the start:
    std::int64_t now = 0;
    std::int64_t note_at = -1;  // sounding or awaited; -1: none
    std::int64_t next_at = silence_frames;
};

void send(void* buffer, jack_nframes_t frame, std::array<jack_midi_data_t, 3> message) {
    jack_midi_event_write(buffer, frame, message.data(), message.size());
}

/// The delay of the note under way, if its sound begins in this block.
void listen(Probe& probe, const float* in, jack_nframes_t frames, void* midi) {
    for (jack_nframes_t n = 0; n < frames && probe.note_at >= 0; ++n) {
        const std::int64_t waited = probe.now + n - probe.note_at;
        const bool heard = waited >= 0 && in[n] != 0.0F;
        if (!heard && waited < patience_frames) continue;
        const std::size_t index = probe.measured.load();
        probe.delay[index] = heard ? waited : -1;
        probe.measured.store(index + 1);
        probe.note_at = -1;
        probe.next_at = probe.now + frames + silence_frames + 37 * static_cast<std::int64_t>(index % 97);
        send(midi, 0, {0x80, 40, 64});
        send(midi, 0, {0xB0, 120, 0});
    }
}

int process(jack_nframes_t frames, void* argument) {
    Probe& probe = *static_cast<Probe*>(argument);
    void* midi = jack_port_get_buffer(probe.midi, frames);
    jack_midi_clear_buffer(midi);
    listen(probe, static_cast<const float*>(jack_port_get_buffer(probe.audio, frames)), frames, midi);
    const bool due = probe.note_at < 0 && probe.next_at < probe.now + frames;
    if (due && probe.measured.load() < probe.wanted) {
        const auto offset =
            static_cast<jack_nframes_t>(probe.next_at > probe.now ? probe.next_at - probe.now : 0);
        probe.note_at = probe.now + offset;
        send(midi, offset, {0x90, 40, 100});
    }
    probe.now += frames;
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) {
        std::fputs("usage: loop_probe NOTES MIDI-INPUT AUDIO-OUTPUT\n", stderr);
        return 2;
    }
    static Probe probe;
    probe.wanted = static_cast<std::size_t>(std::atoi(argv[1]));
    jack_client_t* client = jack_client_open("loop-probe", JackNoStartServer, nullptr);
    if (client == nullptr || probe.wanted > most_notes) return 1;
    probe.midi = jack_port_register(client, "midi", JACK_DEFAULT_MIDI_TYPE, JackPortIsOutput, 0);
    probe.audio = jack_port_register(client, "audio", JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput, 0);
    jack_set_process_callback(client, &process, &probe);
    if (jack_activate(client) != 0 || jack_connect(client, "loop-probe:midi", argv[2]) != 0 ||
        jack_connect(client, argv[3], "loop-probe:audio") != 0)
        return 1;
    while (probe.measured.load() < probe.wanted) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    jack_client_close(client);
    for (std::size_t i = 0; i < probe.wanted; ++i)
        std::printf("%lld\n", static_cast<long long>(probe.delay[i]));
    return 0;
}
