#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

#include "arguments.h"
#include "arrays.h"
#include "base/text.h"
#include "bind.h"
#include "errors.h"
#include "jawari/scene/energy.h"

namespace jawari::python {

namespace py = pybind11;

namespace {

/// Of one thread at a time; another one is told so.
class Claim {
  public:
    explicit Claim(Stepper& stepper) : stepper_(stepper) {
        if (!stepper.claim())
            raise(host::usage_error("simulation", "in use by another thread",
                                    "one thread at a time, or a copy()"));
    }
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;
    ~Claim() { stepper_.release(); }

  private:
    Stepper& stepper_;
};

std::unique_ptr<Stepper> make(const py::object& text, const std::string& name, const py::dict& settings) {
    host::Scene scene = scene_from(text, name);
    const RecordOptions options = record_options(settings);
    auto stepper = [&] {
        const py::gil_scoped_release released;
        return Stepper::create(std::move(scene), options);
    }();
    return value_or_raise(std::move(stepper));
}

const StringShape& shape_of(const Stepper& stepper, std::size_t string) {
    const std::size_t strings = stepper.model().strings.size();
    if (string >= strings)
        raise(host::usage_error("string", std::to_string(string), "0 to " + std::to_string(strings - 1)));
    return *stepper.model().strings[string].shape;
}

/// Rows of a tenth of a second of work or so between two looks at signals.
constexpr std::size_t rows_at_once = 64;

std::vector<py::array> advance(Stepper& stepper, std::size_t frames) {
    const Claim claim(stepper);
    std::vector<std::vector<double>> values(stepper.labels().size());
    host::MaybeError stopped;
    {
        const py::gil_scoped_release released;
        const Poll poll = signal_poll();
        for (auto& probe : values) probe.reserve(frames);
        for (std::size_t left = frames; left > 0 && !stopped;) {
            const std::size_t count = std::min(left, rows_at_once);
            stepper.advance(count, values);
            left -= count;
            stopped = poll();
        }
    }
    if (stopped) raise(*stopped);
    std::vector<py::array> arrays;
    for (auto& probe : values) arrays.push_back(take(std::move(probe)));
    return arrays;
}

void set_modes(Stepper& stepper, std::size_t string, const py::array_t<double, py::array::forcecast>& q,
               const py::array_t<double, py::array::forcecast>& v) {
    const auto modes = static_cast<py::ssize_t>(shape_of(stepper, string).mode_count);
    for (const auto& [name, array] : {std::pair{"q", q}, std::pair{"v", v}})
        if (array.ndim() != 1 || array.size() != modes)
            raise(host::usage_error(name, std::to_string(array.size()) + " values",
                                    std::to_string(modes) + ", one per mode"));
    const Claim claim(stepper);
    const auto dense_q = py::array_t<double, py::array::c_style>::ensure(q);
    const auto dense_v = py::array_t<double, py::array::c_style>::ensure(v);
    stepper.set_modes(string, dense_q.data(), dense_v.data());
}

void move_contact(Stepper& stepper, std::size_t string, std::size_t contact, double height_m,
                  double duration_s) {
    const std::size_t contacts = shape_of(stepper, string).contact_of_description.size();
    if (contact >= contacts)
        raise(host::usage_error("contact", std::to_string(contact), "below " + std::to_string(contacts)));
    if (!std::isfinite(height_m))
        raise(host::usage_error("height_m", host::shortest(height_m), "finite numbers"));
    if (auto error = check_duration(duration_s)) raise(*error);
    const Claim claim(stepper);
    stepper.move_contact(string, contact, height_m, duration_s);
}

/// An array over `values` of the string, for as long as `self` lives.
template <class Values>
py::array string_view(const py::object& self, std::size_t string, Values values) {
    const auto& stepper = self.cast<const Stepper&>();
    const StringShape& shape = shape_of(stepper, string);
    const auto [data, size] = values(shape, stepper.state().strings[string]);
    return view(data, size, self);
}

using Span = std::pair<const double*, std::size_t>;

py::dict facts(const Stepper& stepper, std::size_t string) {
    const StringShape& shape = shape_of(stepper, string);
    py::dict result;
    result["name"] = py::bytes(stepper.scene().description.strings[string].name);
    result["modes"] = shape.mode_count;
    result["contacts"] = stepper.contacts(string);
    result["contact_position_m"] = shape.contact_position;
    return result;
}

}  // namespace

void bind_stepper(py::module_& module) {
    py::class_<Stepper> stepper(module, "Stepper");
    stepper.def(py::init(&make), py::arg("text"), py::arg("name"), py::arg("settings"));
    stepper.def("copy", [](Stepper& self) {
        const Claim claim(self);
        return self.copy();
    });
    stepper.def("advance", &advance, py::arg("frames"));
    stepper.def("reset", [](Stepper& self) {
        const Claim claim(self);
        self.reset();
    });
    stepper.def("save", [](Stepper& self) {
        const Claim claim(self);
        const std::vector<std::uint8_t> bytes = self.save();
        return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    });
    stepper.def(
        "restore",
        [](Stepper& self, const std::string& bytes) {
            const Claim claim(self);
            return value_or_raise(
                self.restore({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}));
        },
        py::arg("bytes"));
    stepper.def("set_modes", &set_modes, py::arg("string"), py::arg("q"), py::arg("v"));
    stepper.def("move_contact", &move_contact, py::arg("string"), py::arg("contact"), py::arg("height_m"),
                py::arg("duration_s"));
    stepper.def_property_readonly("frame", &Stepper::frame);
    stepper.def_property_readonly("time_s", &Stepper::time_s);
    stepper.def_property_readonly("duration_s", [](const Stepper& self) { return self.scene().duration_s; });
    stepper.def_property_readonly("output_rate_hz",
                                  [](const Stepper& self) { return self.model().output_rate_hz; });
    stepper.def_property_readonly("contact_rate_hz",
                                  [](const Stepper& self) { return self.model().contact_rate_hz; });
    stepper.def_property_readonly("string_count",
                                  [](const Stepper& self) { return self.model().strings.size(); });
    stepper.def_property_readonly("probe_names", [](const Stepper& self) {
        py::list names;
        for (const host::ProbeLabel& label : self.labels()) names.append(py::bytes(label.name));
        return names;
    });
    stepper.def("probe_values", [](const Stepper& self) { return take(self.probe_values()); });
    stepper.def("facts", &facts, py::arg("string"));
    stepper.def("energy_J", [](const Stepper& self, std::size_t string) {
        shape_of(self, string);
        return energy(self.model().strings[string], self.state().strings[string]);
    });
    stepper.def("impulses", [](const Stepper& self, std::size_t string) {
        shape_of(self, string);
        return self.state().strings[string].counters.impulses;
    });
    stepper.def("gap_m", [](const Stepper& self, std::size_t string) {
        shape_of(self, string);
        return take(self.gaps(string));
    });
    stepper.def("q", [](const py::object& self, std::size_t string) {
        return string_view(self, string, [](const StringShape& shape, const StringState& state) {
            return Span(state.displacement.data(), shape.mode_count);
        });
    });
    stepper.def("v", [](const py::object& self, std::size_t string) {
        return string_view(self, string, [](const StringShape& shape, const StringState& state) {
            return Span(state.velocity.data(), shape.mode_count);
        });
    });
    stepper.def("impulse_Ns", [](const py::object& self, std::size_t string) {
        return string_view(self, string, [](const StringShape& shape, const StringState& state) {
            return Span(state.contact.frame_impulse.data(), shape.contact_count);
        });
    });
    stepper.def("contact_height_m", [](const py::object& self, std::size_t string) {
        return string_view(self, string, [](const StringShape& shape, const StringState& state) {
            return Span(state.contact.height.data(), shape.contact_count);
        });
    });
}

}  // namespace jawari::python
