// Scene JSON (docs/formats/scene.md) -> Scene.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "formats/scene/scene.h"

namespace jawari::host {

/// `file`: how messages call it. Types, keys and sizes are checked here, values by compile().
Outcome<Scene> read_scene(const std::string& text, const std::string& file);

/// A file if there is one of that name, else a built-in scene such as `lab/bass`; `-` is standard input.
Outcome<Scene> load_scene(const std::string& argument);

/// Names of the built-in scenes.
std::vector<std::string> builtin_scene_names();

}  // namespace jawari::host
