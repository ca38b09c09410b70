#include "formats/scene/time_table.h"

#include <algorithm>
#include <cmath>

namespace jawari::host {

namespace {

double last_time(const TimeTable& table) {
    if (table.time_s.empty())
        return table.value.empty() ? 0 : static_cast<double>(table.value.size() - 1) / table.rate_hz;
    return table.time_s.back();
}

double at_rate(const TimeTable& table, double time_s) {
    const double place = time_s * table.rate_hz;
    const double whole = std::floor(place);
    const auto index = static_cast<std::size_t>(whole);
    if (index + 1 >= table.value.size()) return table.value.back();
    return table.value[index] + (place - whole) * (table.value[index + 1] - table.value[index]);
}

double at_times(const TimeTable& table, double time_s) {
    const auto after = std::upper_bound(table.time_s.begin(), table.time_s.end(), time_s);
    const auto next = static_cast<std::size_t>(after - table.time_s.begin());
    if (next == table.time_s.size()) return table.value.back();
    const double share = (time_s - table.time_s[next - 1]) / (table.time_s[next] - table.time_s[next - 1]);
    return table.value[next - 1] + share * (table.value[next] - table.value[next - 1]);
}

double value_at(const TimeTable& table, double time_s, Outside outside) {
    const double first = table.time_s.empty() ? 0 : table.time_s.front();
    if (time_s < first) return outside == Outside::Zero ? 0 : table.value.front();
    if (time_s > last_time(table)) return outside == Outside::Zero ? 0 : table.value.back();
    return table.time_s.empty() ? at_rate(table, time_s) : at_times(table, time_s);
}

}  // namespace

std::vector<double> sample(const TimeTable& table, double rate_hz, std::size_t most, Outside outside) {
    std::vector<double> samples;
    if (table.value.empty()) return samples;
    // One frame past the end, so that a force ends and a height arrives.
    const double frames = std::min(std::ceil(last_time(table) * rate_hz) + 2, static_cast<double>(most));
    for (std::size_t n = 0; n < static_cast<std::size_t>(frames); ++n)
        samples.push_back(value_at(table, static_cast<double>(n) / rate_hz, outside));
    return samples;
}

std::vector<std::string_view> table_keys(std::string_view value_key, std::string_view scale_key) {
    return {"time_s", value_key, "sound", "channel", scale_key};
}

TimeTable read_time_table(json::ObjectReader& reader, std::string_view value_key,
                          std::string_view scale_key) {
    TimeTable table;
    table.place = reader.path();
    json::Problems& problems = reader.problems();
    if (reader.has("sound")) {
        if (reader.has("time_s") || reader.has(value_key))
            problems.add(reader.path_of("sound"), "beside a table", "either a sound or a table");
        table.sound = reader.text("sound");
        table.scale = reader.number_or(scale_key, 1);
        if (reader.has("channel")) table.channel = reader.whole_number("channel", 0, 1023);
        if (table.sound.empty()) problems.add(reader.path_of("sound"), "\"\"", "the name of a sound file");
        return table;
    }
    table.time_s = reader.numbers("time_s", most_table_values);
    table.value = reader.numbers(value_key, most_table_values);
    if (problems.any()) return table;
    if (table.time_s.empty()) problems.add(reader.path_of("time_s"), "an empty array", "at least one time");
    if (table.value.size() != table.time_s.size()) {
        problems.add(reader.path_of(value_key), std::to_string(table.value.size()) + " values",
                     std::to_string(table.time_s.size()) + " values, as many as time_s");
    }
    for (std::size_t i = 0; i < table.time_s.size() && !problems.any(); ++i) {
        const double least = i == 0 ? 0 : table.time_s[i - 1];
        json::read_number(json::Value{table.time_s[i]}, json::indexed(reader.path_of("time_s"), i),
                          json::Range{least, 1e9}, problems);
    }
    return table;
}

}  // namespace jawari::host
