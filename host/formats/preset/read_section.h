// What the readers of a preset's sections share: keys with their provenance, lists, places on the string.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "formats/json/object_reader.h"
#include "jawari/instrument/description.h"

namespace jawari::host::preset {

/// An object of a preset: besides `allowed` it may hold `provenance`, an object whose keys are keys of this
/// object and whose values say where the value comes from: a text that begins with `measured`, `published` or
/// `chosen`.
class Section : public json::ObjectReader {
  public:
    Section(const json::Value& value, const std::string& path,
            std::initializer_list<std::string_view> allowed, json::Problems& problems);

    /// The value, or `fallback` if the key is absent.
    bool flag_or(std::string_view key, bool fallback);
    std::vector<std::size_t> indices_or_empty(std::string_view key, std::size_t longest);
    /// Two numbers, or the fallback.
    std::pair<double, double> pair_or(std::string_view key, std::pair<double, double> fallback);
    /// `position_from_bridge_m` or `position_share`, one of the two.
    StringPlace place();
};

StringPlace read_place(const json::Value& value, const std::string& path, json::Problems& problems);

/// An array of objects, each read by `read`.
template <class T>
std::vector<T> read_list(json::ObjectReader& reader, std::string_view key, std::size_t longest,
                         T (*read)(const json::Value&, const std::string&, json::Problems&)) {
    std::vector<T> list;
    const json::Array* array = reader.array(key, longest);
    if (array == nullptr) return list;
    for (std::size_t i = 0; i < array->size() && !reader.problems().any(); ++i) {
        list.push_back(read((*array)[i], json::indexed(reader.path_of(key), i), reader.problems()));
    }
    return list;
}

template <class T>
std::vector<T> read_list_or_empty(json::ObjectReader& reader, std::string_view key, std::size_t longest,
                                  T (*read)(const json::Value&, const std::string&, json::Problems&)) {
    return reader.has(key) ? read_list(reader, key, longest, read) : std::vector<T>{};
}

}  // namespace jawari::host::preset
