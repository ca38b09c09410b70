#include "commands/play/monitor_text.h"

#include <gtest/gtest.h>

namespace jawari::host {
namespace {

TEST(KeyName, CountsOctavesFromMiddleC) {
    EXPECT_EQ(key_name(60), "C4");
    EXPECT_EQ(key_name(69), "A4");
    EXPECT_EQ(key_name(0), "C-1");
    EXPECT_EQ(key_name(127), "G9");
    EXPECT_EQ(key_name(54), "F#3");
}

TEST(MessageText, SaysEveryKind) {
    EXPECT_EQ(message_text({0x90, 40, 100}), "ch 1  note on     E2   (40)  velocity 100");
    EXPECT_EQ(message_text({0x9F, 40, 0}), "ch 16 note off    E2   (40)  velocity 0");
    EXPECT_EQ(message_text({0x80, 40, 64}), "ch 1  note off    E2   (40)  velocity 64");
    EXPECT_EQ(message_text({0xA0, 40, 7}), "ch 1  pressure    E2   (40)  7");
    EXPECT_EQ(message_text({0xB1, 64, 127}), "ch 2  controller  64 sustain: 127");
    EXPECT_EQ(message_text({0xB1, 20, 1}), "ch 2  controller  20 : 1");
    EXPECT_EQ(message_text({0xC0, 26, 0}), "ch 1  program     26");
    EXPECT_EQ(message_text({0xD0, 99, 0}), "ch 1  pressure    99");
    EXPECT_EQ(message_text({0xE0, 0, 64}), "ch 1  bend        +0");
    EXPECT_EQ(message_text({0xE0, 0, 0}), "ch 1  bend        -8192");
}

}  // namespace
}  // namespace jawari::host
