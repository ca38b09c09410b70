#include "commands/play/status_line.h"

#include <gtest/gtest.h>

namespace jawari::host {
namespace {

TEST(Meter, GoesFromMinus60DecibelsToFullScale) {
    EXPECT_EQ(meter(0, 6), "------|");
    EXPECT_EQ(meter(1e-3, 6), "------|");
    EXPECT_EQ(meter(0.1001, 6), "####--|");  // -20 dBFS
    EXPECT_EQ(meter(1, 6), "######|");
    EXPECT_EQ(meter(1.01, 6), "######!");
}

TEST(StatusText, SaysWhatMattersAndFits) {
    StatusFacts facts;
    facts.preset = "sitar";
    facts.worst_load = 0.456;
    facts.live.mean_load = 0.123;
    facts.live.peak_right = 0.5;
    facts.live.held_notes = 3;
    facts.live.xruns = 2;
    EXPECT_EQ(status_text(facts, 200), "##############--| load 12% worst 46%  notes 3  xruns 2  sitar");
    facts.live.overload_level = 1;
    facts.recorded_s = 65;
    facts.audio_runs = false;
    facts.preset = "caf\xC3\xA9\n";
    EXPECT_EQ(
        status_text(facts, 200),
        "##############--| NO AUDIO  load 12% worst 46%  notes 3  xruns 2  OVERLOAD 1  REC 1:05  caf??\\x0a");
    EXPECT_EQ(status_text(facts, 10).size(), 10U);
}

}  // namespace
}  // namespace jawari::host
