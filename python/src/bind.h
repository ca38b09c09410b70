// The parts of the module jawari._core; python/jawari puts Python's names and documentation over them.
#pragma once

#include <pybind11/pybind11.h>

#include "stepper.h"

namespace jawari::python {

void bind_record(pybind11::module_& module);
void bind_stepper(pybind11::module_& module);
void bind_play(pybind11::module_& module);

}  // namespace jawari::python
