// Qualities as command lines spell them.
#pragma once

#include <map>
#include <string>

#include "jawari/scene/resolution.h"

namespace jawari::host {

inline std::map<std::string, Quality> quality_words() {
    std::map<std::string, Quality> words;
    for (const Quality quality : {Quality::Live, Quality::Studio, Quality::Reference})
        words.emplace(name_of(quality), quality);
    return words;
}

}  // namespace jawari::host
