// What Python hands over, as the host's options.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "formats/scene/scene.h"
#include "recording.h"

namespace jawari::python {

/// `text`: a scene's JSON, which messages call `name`; None: `name` is a file or a built-in scene. Releases
/// the GIL while it reads.
host::Scene scene_from(const pybind11::object& text, const std::string& name);

/// Keys are those of jawari.simulate(); None counts as absent.
RecordOptions record_options(const pybind11::dict& settings);

}  // namespace jawari::python
