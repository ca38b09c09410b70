// Runs gnuplot on a script. gnuplot reads the script from its standard input and writes the picture to its
// standard output, so that no file name and no shell is involved; text that comes from users enters scripts
// through quote() only.
#pragma once

#include <string>
#include <string_view>

#include "base/error.h"

namespace jawari::host::plot {

enum class PictureFormat { Svg, Png };

/// By the extension: `.svg` or `.png`; a wrong command line otherwise.
Outcome<PictureFormat> picture_format(const std::string& path);

/// Before any work is done: the extension is known and gnuplot is installed.
MaybeError can_plot(const std::string& path);

/// A gnuplot string constant with this text: single-quoted, in which gnuplot substitutes nothing. Control
/// characters become spaces and bytes that are no UTF-8 question marks, so that the picture stays readable by
/// XML parsers.
std::string quote(std::string_view text);

/// The `set terminal` line for a picture of this size [px].
std::string terminal(PictureFormat format, int width, int height);

/// Draws `script` (all but the terminal) into the file, which appears whole or not at all.
MaybeError draw(const std::string& path, int width, int height, const std::string& script);

}  // namespace jawari::host::plot
