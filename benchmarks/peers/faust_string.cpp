// CPU seconds per second of sound of one Faust instrument at 48 kHz; FAUST_CLASS is the file that the Faust
// compiler wrote.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

struct Meta {
    void declare(const char* /*key*/, const char* /*value*/) {}
};

/// Remembers the gate's place and ignores the rest of the interface.
struct UI {
    float* gate = nullptr;
    void openVerticalBox(const char* /*label*/) {}
    void openHorizontalBox(const char* /*label*/) {}
    void closeBox() {}
    void addButton(const char* /*label*/, float* zone) { gate = zone; }
    void declare(float* /*zone*/, const char* /*key*/, const char* /*value*/) {}
};

struct dsp {
    virtual ~dsp() = default;
};

#define FAUSTFLOAT float
#include FAUST_CLASS

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const double seconds = std::atof(argv[1]);
    constexpr int block = 64;
    std::vector<float> samples(block);
    float* outputs[] = {samples.data()};
    double least = 1e300, sum = 0;
    for (int trial = 0; trial < 5; ++trial) {
        auto* instrument = new mydsp;
        instrument->init(48000);
        UI ui;
        instrument->buildUserInterface(&ui);
        *ui.gate = 1;
        timespec start{}, stop{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &start);
        for (long n = 0; n < static_cast<long>(48000 * seconds); n += block) {
            instrument->compute(block, nullptr, outputs);
            sum += static_cast<double>(samples[0]);
        }
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &stop);
        const double cpu = static_cast<double>(stop.tv_sec - start.tv_sec) +
                           1e-9 * static_cast<double>(stop.tv_nsec - start.tv_nsec);
        least = cpu < least ? cpu : least;
        delete instrument;
    }
    std::printf("%.9g %g\n", least / seconds, sum);
    return 0;
}
