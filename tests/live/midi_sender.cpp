// A MIDI keyboard made of text: a virtual port that sends what standard input says. A line is `DELAY_MS BYTE
// BYTE BYTE` with bytes in hexadecimal; the delay counts from the line before, so that errors do not add up.
// `unplug` takes the port away, `plug` brings it back. After each line the time on CLOCK_MONOTONIC is
// printed. Ends with its input.
#include <RtMidi.h>

#include <chrono>
#include <cstdint>
#include <iostream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

int main(int argc, char** argv) {
    if (argc != 3) {
        std::cerr << "usage: midi_sender SYSTEM NAME\n";
        return 2;
    }
    try {
        RtMidiOut midi(RtMidi::getCompiledApiByName(argv[1]), argv[2]);
        midi.openVirtualPort("out");
        std::cout << "ready" << std::endl;
        auto due = std::chrono::steady_clock::now();
        bool begun = false;
        std::string line;
        while (std::getline(std::cin, line)) {
            if (line == "plug" || line == "unplug") {
                if (line == "plug")
                    midi.openVirtualPort("out");
                else
                    midi.closePort();
                begun = false;
                std::cout << std::chrono::steady_clock::now().time_since_epoch().count() << std::endl;
                continue;
            }
            std::istringstream words(line);
            double delay_ms = 0;
            words >> delay_ms;
            std::vector<unsigned char> message;
            for (unsigned int byte = 0; words >> std::hex >> byte;)
                message.push_back(static_cast<unsigned char>(byte));
            if (!begun) due = std::chrono::steady_clock::now();
            begun = true;
            due += std::chrono::nanoseconds(static_cast<std::int64_t>(delay_ms * 1e6));
            std::this_thread::sleep_until(due);
            if (!message.empty()) midi.sendMessage(&message);
            std::cout << std::chrono::steady_clock::now().time_since_epoch().count() << std::endl;
        }
    } catch (const RtMidiError& problem) {
        std::cerr << "midi_sender: " << problem.getMessage() << "\n";
        return 1;
    }
    return 0;
}
