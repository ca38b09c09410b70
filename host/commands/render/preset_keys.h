// Which keys presets have strings for, and who plays the others.
#pragma once

#include <bitset>
#include <map>
#include <mutex>
#include <string>

#include "instrument/instrument_cache.h"

namespace jawari::host {

/// Loads each preset once, when it is first asked for. Several threads may ask at a time.
class PresetKeys {
  public:
    explicit PresetKeys(InstrumentSettings settings);

    /// The preset itself if it has the key, or none of its neighbours has; a gap within its range stays one.
    std::string player_of(const std::string& preset, int key);

  private:
    using Keys = std::bitset<128>;
    const Keys& keys_of(const std::string& preset);

    InstrumentSettings settings_;
    std::mutex mutex_;
    std::map<std::string, Keys> keys_;
};

}  // namespace jawari::host
