// Plays messages into a JACK client at their frames and takes down what it answers, sample for sample:
//   jack_take MIDI_IN OUT_LEFT OUT_RIGHT FRAMES FILE < lines "frame status data1 data2", in order
// FILE: float samples of two channels, interleaved. The answer may be late by a period: JACK cannot have it
// in the same cycle.
#include <jack/jack.h>
#include <jack/midiport.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

namespace {

struct Message {
    std::uint64_t frame = 0;
    std::array<jack_midi_data_t, 3> bytes{};
};

struct Take {
    jack_port_t* midi = nullptr;
    std::array<jack_port_t*, 2> audio{};
    std::vector<Message> messages;
    std::vector<float> samples;
    std::atomic<bool> runs{false};
    std::atomic<bool> done{false};
    // Of the process thread:
    std::uint64_t now = 0;
    std::size_t next = 0;
};

int process(jack_nframes_t frames, void* argument) {
    Take& take = *static_cast<Take*>(argument);
    void* const midi = jack_port_get_buffer(take.midi, frames);
    jack_midi_clear_buffer(midi);
    if (!take.runs.load() || take.done.load()) return 0;
    for (; take.next < take.messages.size() && take.messages[take.next].frame < take.now + frames;
         ++take.next) {
        const Message& message = take.messages[take.next];
        const std::size_t size = (message.bytes[0] & 0xE0U) == 0xC0U ? 2 : 3;
        jack_midi_event_write(midi, static_cast<jack_nframes_t>(message.frame - take.now),
                              message.bytes.data(), size);
    }
    std::array<const float*, 2> in{};
    for (std::size_t side = 0; side < 2; ++side)
        in[side] = static_cast<const float*>(jack_port_get_buffer(take.audio[side], frames));
    for (jack_nframes_t n = 0; n < frames; ++n) {
        const std::uint64_t place = 2 * (take.now + n);
        if (place + 1 >= take.samples.size()) break;
        for (std::size_t side = 0; side < 2; ++side) take.samples[place + side] = in[side][n];
    }
    take.now += frames;
    if (2 * take.now >= take.samples.size()) take.done.store(true);
    return 0;
}

std::vector<Message> read_messages() {
    std::vector<Message> messages;
    std::uint64_t frame = 0;
    std::array<int, 3> bytes{};
    while (std::cin >> frame >> bytes[0] >> bytes[1] >> bytes[2])
        messages.push_back({frame,
                            {static_cast<jack_midi_data_t>(bytes[0]), static_cast<jack_midi_data_t>(bytes[1]),
                             static_cast<jack_midi_data_t>(bytes[2])}});
    return messages;
}

[[noreturn]] void fail(const std::string& why) {
    std::fprintf(stderr, "jack_take: %s\n", why.c_str());
    std::exit(1);
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 6) fail("usage: jack_take MIDI_IN OUT_LEFT OUT_RIGHT FRAMES FILE");
    Take take;
    take.messages = read_messages();
    take.samples.resize(2 * std::strtoull(arguments[4], nullptr, 10));
    jack_client_t* const client = jack_client_open("jack_take", JackNoStartServer, nullptr);
    if (client == nullptr) fail("no JACK server");
    take.midi = jack_port_register(client, "midi", JACK_DEFAULT_MIDI_TYPE, JackPortIsOutput, 0);
    take.audio[0] = jack_port_register(client, "left", JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput, 0);
    take.audio[1] = jack_port_register(client, "right", JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput, 0);
    jack_set_process_callback(client, process, &take);
    if (jack_activate(client) != 0) fail("JACK does not start it");
    if (jack_connect(client, jack_port_name(take.midi), arguments[1]) != 0) fail(arguments[1]);
    for (std::size_t side = 0; side < 2; ++side)
        if (jack_connect(client, arguments[2 + side], jack_port_name(take.audio[side])) != 0)
            fail(arguments[2 + side]);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // connections take effect
    take.runs.store(true);
    while (!take.done.load()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    jack_client_close(client);
    std::ofstream file(arguments[5], std::ios::binary);
    file.write(reinterpret_cast<const char*>(take.samples.data()),
               static_cast<std::streamsize>(take.samples.size() * sizeof(float)));
    file.close();
    return file ? 0 : 1;
}
