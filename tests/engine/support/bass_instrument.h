// A four-string bass with the frets of the published bass (Issanchou et al. 2018), as a description for
// tests: cheap enough to render often.
#pragma once

#include <vector>

#include "jawari/instrument/description.h"

namespace jawari::test {

inline InstrumentDescription bass_instrument() {
    InstrumentDescription bass;
    bass.name = "test bass";
    bass.gain = 0.3;
    bass.quality = {.contact_rate_min_hz = 200000, .mode_limit_hz = 12000};
    bass.hand.release_t60_s = 0.1;
    bass.exciters = {{.name = "finger",
                      .place = {.from_bridge_m = 0.16},
                      .body = FingerDescription{.full_height_m = 0.004, .height_exponent = 1.7}}};
    bass.frets.height_m = {-0.00063, -0.00088, -0.00113, -0.00133,  -0.00158,  -0.00173, -0.00188,
                           -0.00198, -0.00213, -0.00218, -0.00223,  -0.00233,  -0.00233, -0.00233,
                           -0.00233, -0.00233, -0.00233, -0.002335, -0.002335, -0.002335};
    bass.frets.count = bass.frets.height_m.size();
    bass.pickups = {{.place = {.from_bridge_m = 0.09}, .width_m = 0.02, .level = 1}};
    struct Row {
        const char* name;
        int note;
        double frequency_hz, density, inharmonicity, diameter_m;
    };
    for (const Row& row :
         {Row{"E", 28, 41.20344461410875, 0.0354, 9e-5, 0.00267}, Row{"A", 33, 55.0, 0.0239, 6e-5, 0.00216},
          Row{"D", 38, 73.41619197935188, 0.0142, 4e-5, 0.00165},
          Row{"G", 43, 97.99885899543733, 0.0067, 3.5e-5, 0.00114}}) {
        InstrumentStringDescription string;
        string.name = row.name;
        string.open_note = row.note;
        string.open_frequency_hz = row.frequency_hz;
        string.length_m = 0.863;
        string.linear_density_kg_per_m = row.density;
        string.inharmonicity = row.inharmonicity;
        string.damping = ValetteLoss{row.diameter_m, 1.8e-5, 1.2, 0.01, 3.3e-5};
        bass.strings.push_back(string);
    }
    return bass;
}

}  // namespace jawari::test
