// The state: one property, a text as bytes. Not an atom:String: hosts keep those in Turtle, where serd
// 0.30.16 (Debian 12) reads a quotation mark before an escape as something else, and JSON inside JSON is full
// of them.
#include <cstring>
#include <string>
#include <string_view>

#include "plugin/lv2/instance.h"

namespace jawari::host::lv2 {

namespace {

LV2_State_Status save(LV2_Handle handle, LV2_State_Store_Function store, LV2_State_Handle host,
                      std::uint32_t /*flags*/, const LV2_Feature* const* /*features*/) {
    Instance& instance = instance_of(handle);
    LV2_State_Status status = LV2_STATE_ERR_UNKNOWN;
    guarded([&] {
        const std::lock_guard lock(instance.control);
        const std::string text = instance.core.save();
        status = store(host, instance.urids.state, text.data(), text.size(), instance.urids.atom_chunk,
                       LV2_STATE_IS_POD | LV2_STATE_IS_PORTABLE);
        return true;
    });
    return status;
}

/// Without the property everything stays.
LV2_State_Status restore(LV2_Handle handle, LV2_State_Retrieve_Function retrieve, LV2_State_Handle host,
                         std::uint32_t /*flags*/, const LV2_Feature* const* /*features*/) {
    Instance& instance = instance_of(handle);
    std::size_t size = 0;
    std::uint32_t type = 0, flags = 0;
    const auto* const data =
        static_cast<const char*>(retrieve(host, instance.urids.state, &size, &type, &flags));
    if (data == nullptr) return LV2_STATE_SUCCESS;
    if (type != instance.urids.atom_chunk && type != instance.urids.atom_string)
        return LV2_STATE_ERR_BAD_TYPE;
    const std::string_view text(data, strnlen(data, size));
    const bool loaded = guarded([&] {
        const std::lock_guard lock(instance.control);
        const auto error = instance.core.load(text);
        if (error) log_error_of(instance, *error);
        return !error;
    });
    return loaded ? LV2_STATE_SUCCESS : LV2_STATE_ERR_UNKNOWN;
}

}  // namespace

const void* state_interface() {
    static constexpr LV2_State_Interface interface { save, restore };
    return &interface;
}

}  // namespace jawari::host::lv2
