// jawari._core: the extension module under the package jawari.
#include <pybind11/pybind11.h>

#include "bind.h"
#include "errors.h"
#include "jawari/version.h"

PYBIND11_MODULE(_core, module) {
    module.doc() = "The engine and the host of jawari; use the package jawari.";
    module.attr("__version__") = JAWARI_VERSION;
    jawari::python::translate_host_errors();
    jawari::python::bind_record(module);
    jawari::python::bind_stepper(module);
    jawari::python::bind_play(module);
}
