// A string's model while compile() fills it: the only place where its shape can be written.
#pragma once

#include <memory>

#include "jawari/detail/string_model.h"

namespace jawari {

struct StringDraft {
    std::shared_ptr<StringShape> shape = std::make_shared<StringShape>();
    StringModel model{shape, {}};  ///< reads `shape`, which is frozen once the draft is gone
};

}  // namespace jawari
