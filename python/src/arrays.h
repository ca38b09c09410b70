// Memory of C++ as NumPy's arrays, without a copy.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <utility>
#include <vector>

namespace jawari::python {

using Shape = std::vector<pybind11::ssize_t>;

/// The array owns what was the vector's memory.
template <class T>
pybind11::array_t<T> take(std::vector<T>&& values, const Shape& shape) {
    auto owned = std::make_unique<std::vector<T>>(std::move(values));
    T* data = owned->data();
    const pybind11::capsule owner(owned.release(),
                                  [](void* pointer) { delete static_cast<std::vector<T>*>(pointer); });
    return pybind11::array_t<T>(shape, data, owner);
}

template <class T>
pybind11::array_t<T> take(std::vector<T>&& values) {
    const auto size = static_cast<pybind11::ssize_t>(values.size());
    return take(std::move(values), Shape{size});
}

/// Looks at memory that `owner` keeps alive; Python cannot write to it.
inline pybind11::array view(const double* values, std::size_t size, const pybind11::handle& owner) {
    pybind11::array_t<double> array(static_cast<pybind11::ssize_t>(size), values, owner);
    array.attr("setflags")(false);
    return array;
}

}  // namespace jawari::python
