#include "render/quality.h"

#include <gtest/gtest.h>

namespace jawari::host {
namespace {

TEST(Quality, LiveStudioAndReference) {
    InstrumentDescription instrument;
    instrument.quality = {500000, 20000};
    EXPECT_EQ(at_quality(instrument, Quality::Live).mode_limit_hz, 20000);
    EXPECT_EQ(at_quality(instrument, Quality::Studio).mode_limit_hz, 20000);
    EXPECT_EQ(at_quality(instrument, Quality::Reference).contact_rate_min_hz, 1e6);
    instrument.studio = QualityDescription{2000000, 80000};
    EXPECT_EQ(at_quality(instrument, Quality::Live).contact_rate_min_hz, 500000);
    EXPECT_EQ(at_quality(instrument, Quality::Studio).contact_rate_min_hz, 2000000);
    EXPECT_EQ(at_quality(instrument, Quality::Reference).contact_rate_min_hz, 4000000);
    EXPECT_EQ(at_quality(instrument, Quality::Reference).mode_limit_hz, 160000);
    EXPECT_EQ(quality_text(Quality::Studio), "studio");
}

}  // namespace
}  // namespace jawari::host
