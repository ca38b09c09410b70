// The window of the CLAP where there is no display.
#include <clap/ext/gui.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "support/clap_host.h"

namespace jawari::test {
namespace {

TEST(ClapWindow, WithoutADisplayItIsRefusedAndNothingElseChanges) {
    unsetenv("DISPLAY");  // NOLINT(concurrency-mt-unsafe)
    ClapInstance instance;
    ASSERT_TRUE(instance.load(small_state()));
    ASSERT_TRUE(instance.activate());
    const std::string before = instance.save();
    const auto& gui = instance.get<clap_plugin_gui_t>(CLAP_EXT_GUI);
    EXPECT_FALSE(gui.create(instance.plugin, CLAP_WINDOW_API_X11, false));
    EXPECT_FALSE(gui.create(instance.plugin, CLAP_WINDOW_API_X11, true));
    EXPECT_FALSE(gui.create(instance.plugin, CLAP_WINDOW_API_WAYLAND, false));
    EXPECT_FALSE(gui.show(instance.plugin));
    gui.destroy(instance.plugin);
    EXPECT_EQ(instance.timer, CLAP_INVALID_ID);
    instance.events.note_on(0, 40, 0.8);
    instance.render(4800);
    EXPECT_GT(*std::max_element(instance.left.begin(), instance.left.end()), 0);
    EXPECT_EQ(instance.save(), before);
}

}  // namespace
}  // namespace jawari::test
