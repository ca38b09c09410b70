#include "jawari/version.h"

namespace jawari {

const char* version() noexcept {
    return JAWARI_VERSION;
}

}  // namespace jawari
