#include "errors.h"

#include <chrono>

namespace jawari::python {

namespace py = pybind11;

namespace {

const char* class_of(host::ErrorKind kind) {
    switch (kind) {
        case host::ErrorKind::Usage:
            return "UsageError";
        case host::ErrorKind::InvalidInput:
            return "InvalidInput";
        case host::ErrorKind::File:
            return "FileError";
        default:
            return "InternalError";
    }
}

}  // namespace

void translate_host_errors() {
    py::register_local_exception_translator([](std::exception_ptr pointer) {
        try {
            if (pointer) std::rethrow_exception(pointer);
        } catch (const HostError& error) {
            const py::object type = py::module_::import("jawari.errors").attr(class_of(error.kind()));
            // A file's name may hold any bytes.
            const auto text = py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefault(error.what()));
            PyErr_SetObject(type.ptr(), text.ptr());
        }
    });
}

void raise(const host::Error& error) {
    if (PyErr_Occurred() != nullptr) throw py::error_already_set();
    throw HostError(error);
}

Poll signal_poll() {
    using Clock = std::chrono::steady_clock;
    return [last = Clock::now()]() mutable -> host::MaybeError {
        constexpr std::chrono::milliseconds interval(30);
        const auto now = Clock::now();
        if (now - last < interval) return std::nullopt;
        last = now;
        const py::gil_scoped_acquire gil;
        if (PyErr_CheckSignals() == 0) return std::nullopt;
        return host::Error{host::ErrorKind::Interrupted, "interrupted"};
    };
}

}  // namespace jawari::python
