// The lines of Scala's text files (.scl, .kbm) and of similar ones, numbered as an editor numbers them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "jawari/result.h"

namespace jawari::host {

struct ScalaLine {
    std::size_t number = 0;  ///< from 1
    std::string_view text;   ///< without its end
};

/// Ends of lines: LF, CR LF or CR. The text must outlive the lines.
std::vector<ScalaLine> text_lines(std::string_view text);

/// Without those that begin with an exclamation mark: they are comments.
std::vector<ScalaLine> scala_lines(std::string_view text);

/// The comments alone.
std::vector<ScalaLine> scala_comments(std::string_view text);

/// The text up to the first space or tab, after leading ones: what follows a value is ignored.
std::string_view first_word(std::string_view text);

/// Without spaces and tabs at both ends.
std::string_view trimmed(std::string_view text);

/// Whole numbers of up to 18 digits, with a minus sign or none.
std::optional<long long> whole_number(std::string_view text);

/// A failure at a line.
Failure scala_failure(std::size_t line, std::string_view value, std::string allowed);

/// The failure of a file whose line `what` is missing.
Failure scala_missing(std::string_view what, std::string allowed);

}  // namespace jawari::host
