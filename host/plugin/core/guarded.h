// Hosts know no exceptions.
#pragma once

namespace jawari::host {

/// false if the function throws: memory can run out wherever files are read and models compiled.
template <class Function>
bool guarded(Function function) noexcept {
    try {
        return function();
    } catch (...) {
        return false;
    }
}

}  // namespace jawari::host
