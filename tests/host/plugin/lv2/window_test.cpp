// The window of the LV2 where there is none.
#include <gtest/gtest.h>

#include <cstdlib>

#include "support/lv2_ui.h"

namespace jawari::test {
namespace {

int lines_of(const std::string& text) {
    return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

TEST(Lv2Window, WithoutADisplayItIsRefusedAndNothingElseChanges) {
    unsetenv("DISPLAY");  // NOLINT(concurrency-mt-unsafe)
    Lv2Instance instance;
    ASSERT_TRUE(instance.load(small_state()));
    ASSERT_TRUE(instance.activate());
    const std::string before = instance.save();
    for (int n = 0; n < 2; ++n) {
        Lv2Ui ui(instance, {});
        EXPECT_EQ(ui.handle, nullptr);
        EXPECT_NE(ui.log.find("jawari: window: "), std::string::npos) << ui.log;
        EXPECT_EQ(lines_of(ui.log), 1);
    }
    instance.events.note_on(0, 40, 0.8);
    instance.render(4800);
    EXPECT_GT(*std::max_element(instance.left.begin(), instance.left.end()), 0);
    EXPECT_EQ(instance.save(), before);
}

TEST(Lv2Window, WithoutAccessToTheInstanceItIsRefusedInOneLine) {
    Lv2Instance instance;
    Lv2UiOffer offer;
    offer.instance_access = false;
    Lv2Ui ui(instance, offer);
    EXPECT_EQ(ui.handle, nullptr);
    EXPECT_EQ(ui.log, "jawari: window: the host gives no access to the instance (instance-access)\n");
    offer.log = false;
    testing::internal::CaptureStderr();
    const Lv2Ui quiet(instance, offer);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), ui.log);
}

}  // namespace
}  // namespace jawari::test
