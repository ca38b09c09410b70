#include "commands/simulate/hdf5_handle.h"

#include <algorithm>
#include <array>
#include <utility>

namespace jawari::host::hdf5 {

namespace {

Handle scalar_space() {
    return {H5Screate(H5S_SCALAR), H5Sclose};
}

/// UTF-8 of any length; such strings live outside the object header, which holds 64 KiB at most.
Handle text_type() {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    if (H5Tset_size(type.id(), H5T_VARIABLE) < 0 || H5Tset_cset(type.id(), H5T_CSET_UTF8) < 0) return {};
    return type;
}

bool write_attribute(hid_t object, const std::string& name, hid_t file_type, hid_t memory_type,
                     const void* value) {
    const Handle space = scalar_space();
    const Handle attribute(H5Acreate2(object, name.c_str(), file_type, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
    return attribute.ok() && H5Awrite(attribute.id(), memory_type, value) >= 0;
}

std::array<hsize_t, 2> sizes(std::uint64_t rows, const Extent& extent) {
    return {rows, extent.columns.value_or(1)};
}

int rank(const Extent& extent) {
    return extent.columns ? 2 : 1;
}

/// netCDF lists what a group holds in the order in which it was made.
Handle in_order_of_creation(hid_t of) {
    Handle properties(H5Pcreate(of), H5Pclose);
    if (H5Pset_link_creation_order(properties.id(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED) < 0)
        return {};
    return properties;
}

bool empty(const Extent& extent) {
    return extent.rows == 0 || extent.columns == std::size_t{0};
}

}  // namespace

void quiet() {
    H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Handle create_file(const std::string& path) {
    const Handle properties = in_order_of_creation(H5P_FILE_CREATE);
    return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, properties.id(), H5P_DEFAULT), H5Fclose};
}

Handle create_group(hid_t parent, const std::string& name) {
    const Handle properties = in_order_of_creation(H5P_GROUP_CREATE);
    return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, properties.id(), H5P_DEFAULT), H5Gclose};
}

Handle create_table(hid_t parent, const std::string& name, const Extent& extent, bool compressed) {
    const auto size = sizes(extent.rows, extent);
    const Handle space(H5Screate_simple(rank(extent), size.data(), nullptr), H5Sclose);
    const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    if (!empty(extent)) {
        // Chunks of about half a MiB fit HDF5's cache of one MiB per dataset.
        const std::uint64_t per_chunk = std::max<std::uint64_t>(1, 65536 / extent.columns.value_or(1));
        const auto chunk = sizes(std::min(extent.rows, per_chunk), extent);
        if (H5Pset_chunk(properties.id(), rank(extent), chunk.data()) < 0) return {};
        if (compressed && (H5Pset_shuffle(properties.id()) < 0 || H5Pset_deflate(properties.id(), 1) < 0))
            return {};
    }
    return {H5Dcreate2(parent, name.c_str(), H5T_IEEE_F64LE, space.id(), H5P_DEFAULT, properties.id(),
                       H5P_DEFAULT),
            H5Dclose};
}

bool write_rows(const Handle& table, std::uint64_t first, const Extent& block, const double* values) {
    if (empty(block)) return true;
    const std::array<hsize_t, 2> start{first, 0};
    const auto size = sizes(block.rows, block);
    const Handle space(H5Dget_space(table.id()), H5Sclose);
    const Handle memory(H5Screate_simple(rank(block), size.data(), nullptr), H5Sclose);
    return H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr) >=
               0 &&
           H5Dwrite(table.id(), H5T_NATIVE_DOUBLE, memory.id(), space.id(), H5P_DEFAULT, values) >= 0;
}

Handle write_vector(hid_t parent, const std::string& name, const std::vector<double>& values) {
    const hsize_t size = values.size();
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    Handle data(
        H5Dcreate2(parent, name.c_str(), H5T_IEEE_F64LE, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        H5Dclose);
    if (!data.ok() || values.empty()) return data;
    const bool written =
        H5Dwrite(data.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0;
    return written ? std::move(data) : Handle();
}

Handle write_strings(hid_t parent, const std::string& name, const std::vector<std::string>& values) {
    const Handle type = text_type();
    const hsize_t size = values.size();
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    Handle data(
        H5Dcreate2(parent, name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        H5Dclose);
    if (!data.ok() || values.empty()) return data;
    std::vector<const char*> pointers;
    for (const std::string& value : values) pointers.push_back(value.c_str());
    const bool written = H5Dwrite(data.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()) >= 0;
    return written ? std::move(data) : Handle();
}

bool make_scale(const Handle& dataset, const std::string& name) {
    return H5DSset_scale(dataset.id(), name.c_str()) >= 0;
}

bool attach_scales(const Handle& dataset, const std::vector<const Handle*>& scales) {
    for (std::size_t d = 0; d < scales.size(); ++d)
        if (H5DSattach_scale(dataset.id(), scales[d]->id(), static_cast<unsigned>(d)) < 0) return false;
    return true;
}

bool set_attribute(hid_t object, const std::string& name, const std::string& value) {
    const Handle type = text_type();
    const char* pointer = value.c_str();
    return type.ok() && write_attribute(object, name, type.id(), type.id(), &pointer);
}

bool set_attribute(hid_t object, const std::string& name, double value) {
    return write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

bool set_attribute(hid_t object, const std::string& name, std::uint64_t value) {
    return write_attribute(object, name, H5T_STD_U64LE, H5T_NATIVE_UINT64, &value);
}

}  // namespace jawari::host::hdf5
