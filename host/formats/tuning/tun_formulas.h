// [Functional Tuning] and [Mapping] of AnaMark tuning files: pitches by formulas, and keys that play other
// notes. M. Henning, "Specifications AnaMark tuning file format", version 2, 2009.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "formats/tuning/key_frequencies.h"

namespace jawari::host {

/// Frequencies of the notes of a scale, by number [Hz]. What formulas give need not be positive.
using NoteFrequencies = std::array<double, midi_keys>;

/// A frequency that a formula names: a number, a note of the scale, or one so many notes away.
struct FormulaTerm {
    enum class Kind { Value, Note, Distance };
    Kind kind = Kind::Value;
    double value_hz = 0;  ///< of Value
    int notes = 0;        ///< of the others
};

/// f = base * factor / divisor * 2^(cents/1200) + shift, for `loop` notes one after the other; or the whole
/// scale brought to a frequency of this note.
struct TunFormula {
    int note = 0;
    std::optional<double> ensured_hz;               ///< `!`: nothing else counts
    FormulaTerm base{FormulaTerm::Kind::Distance};  ///< `#`
    double factor = 1;                              ///< `*`
    double divisor = 1;                             ///< `/`
    double cents = 0;                               ///< `%`
    FormulaTerm shift;                              ///< `+`
    int loop = 0;                                   ///< `~`: negative goes down
};

/// The formula of a note, without its quotation marks: `#>-12 % 1200 ~999`. Nothing if it is none, divides by
/// zero, or names a note that is not there.
std::optional<TunFormula> read_formula(int note, std::string_view text);

/// Applies it to the scale as formulas before it have left it. A distance that leaves the scale ends it.
void apply(const TunFormula& formula, NoteFrequencies& scale);

/// Which note of the scale a key plays.
struct TunMapping {
    int loop_size = 0;  ///< above 0 the first so many keys count, and repeat so many notes higher
    std::array<int, midi_keys> note_of_key = each_its_own();

    static std::array<int, midi_keys> each_its_own();
    /// 0 to 127, as the format asks.
    [[nodiscard]] int note(int key) const;
};

}  // namespace jawari::host
