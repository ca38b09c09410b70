// The picture of a simulated scene: snapshots of the string over its obstacles, probe signals, and a
// contactogram.
#pragma once

#include <string>

#include "base/error.h"
#include "plot/recording.h"

namespace jawari::host {

/// Draws the recording into `path` (`.svg` or `.png`), which appears whole or not at all. One column of
/// panels per string: the string's shape at several times over the obstacles; one panel of signals for each
/// quantity probed; when and where contacts struck, and how hard. Strings beyond the sixth are left out,
/// which the heading says.
MaybeError plot_scene(const SceneRecording& recording, const std::string& path);

/// The gnuplot script of that picture, without terminal and output, and the size meant for it [px].
struct SceneFigure {
    int width = 0;
    int height = 0;
    std::string script;
};
SceneFigure scene_figure(const SceneRecording& recording);

}  // namespace jawari::host
