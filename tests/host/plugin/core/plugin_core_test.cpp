// What an instance does without a host.
#include <gtest/gtest.h>

#include "plugin/core/plugin_core.h"
#include "support/small_preset.h"

namespace jawari::host {
namespace {

/// Hosts make an instance of everything that they find, and most never play.
TEST(PluginCore, AScanCompilesNothing) {
    PluginCore scanned;
    EXPECT_GT(scanned.save().size(), 1000U);
    scanned.expect_rate(96000);
    scanned.set_value(ParameterId::Volume, 0.5);
    EXPECT_FALSE(scanned.set_offline(true));
    EXPECT_FALSE(scanned.compiled());
    ASSERT_FALSE(scanned.activate(48000));
    EXPECT_TRUE(scanned.compiled());
}

TEST(PluginCore, AStateIsCompiledToBeJudged) {
    PluginCore one;
    ASSERT_FALSE(one.load(test::small_state()));
    EXPECT_TRUE(one.compiled());
}

}  // namespace
}  // namespace jawari::host
