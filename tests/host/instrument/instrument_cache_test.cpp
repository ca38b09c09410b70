#include "instrument/instrument_cache.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>
#include <vector>

namespace jawari::host {
namespace {

TEST(InstrumentCache, EachPresetIsCompiledOnce) {
    InstrumentCache cache({});
    std::vector<SharedInstrument> found(4);
    std::array<bool, 4> compiled{};
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < found.size(); ++i)
        threads.emplace_back([&, i] { found[i] = cache.get("bass-fretted", compiled[i]).value(); });
    for (std::thread& thread : threads) thread.join();
    int count = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i], found[0]);
        count += compiled[i] ? 1 : 0;
    }
    EXPECT_EQ(count, 1);
}

TEST(InstrumentCache, FailuresAreHandedOn) {
    InstrumentCache cache({});
    bool compiled = false;
    EXPECT_EQ(cache.get("no such", compiled).error().kind, ErrorKind::File);
    EXPECT_EQ(cache.get("no such", compiled).error().kind, ErrorKind::File);
    EXPECT_FALSE(compiled);
}

TEST(InstrumentCache, QualityAndTuningAreApplied) {
    InstrumentSettings settings;
    settings.quality = Quality::Reference;
    settings.move_frets = true;
    settings.tuning.emplace().fill(100);
    (*settings.tuning)[3] = std::numeric_limits<double>::quiet_NaN();
    const InstrumentDescription plain = load_with("bass-fretted", {}).value().instrument;
    const InstrumentDescription tuned = load_with("bass-fretted", settings).value().instrument;
    EXPECT_GE(tuned.quality.contact_rate_min_hz, 2 * plain.quality.contact_rate_min_hz);
    ASSERT_EQ(tuned.note_frequency_hz.size(), 128U);
    EXPECT_EQ(tuned.note_frequency_hz[69], 100);
    EXPECT_TRUE(std::isnan(tuned.note_frequency_hz[3]));
    EXPECT_TRUE(tuned.tuning_moves_frets);
    EXPECT_TRUE(plain.note_frequency_hz.empty());
}

}  // namespace
}  // namespace jawari::host
