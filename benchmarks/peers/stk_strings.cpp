// CPU seconds per second of sound of one plucked string of the Synthesis ToolKit at 48 kHz.
#include <stk/Guitar.h>
#include <stk/Plucked.h>
#include <stk/Sitar.h>
#include <stk/StifKarp.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

template <class Tick>
void measure(Tick&& tick, double seconds) {
    double least = 1e300, sum = 0;
    for (int trial = 0; trial < 5; ++trial) {
        timespec start{}, stop{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &start);
        for (long n = 0; n < static_cast<long>(48000 * seconds); ++n) sum += tick();
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &stop);
        const double cpu = static_cast<double>(stop.tv_sec - start.tv_sec) +
                           1e-9 * static_cast<double>(stop.tv_nsec - start.tv_nsec);
        least = cpu < least ? cpu : least;
    }
    std::printf("%.9g %g\n", least / seconds, sum);  // the sum keeps the loop alive
}

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    stk::Stk::setSampleRate(48000);
    const double seconds = std::atof(argv[2]);
    if (std::strcmp(argv[1], "Plucked") == 0) {
        stk::Plucked string(50);
        string.noteOn(110, 0.8);
        measure([&] { return string.tick(); }, seconds);
    } else if (std::strcmp(argv[1], "StifKarp") == 0) {
        stk::StifKarp string(50);
        string.noteOn(110, 0.8);
        measure([&] { return string.tick(); }, seconds);
    } else if (std::strcmp(argv[1], "Sitar") == 0) {
        stk::Sitar string(50);
        string.noteOn(110, 0.8);
        measure([&] { return string.tick(); }, seconds);
    } else if (std::strcmp(argv[1], "Guitar") == 0) {
        stk::Guitar string(1);
        string.noteOn(110, 0.8);
        measure([&] { return string.tick(); }, seconds);
    } else {
        return 2;
    }
    return 0;
}
