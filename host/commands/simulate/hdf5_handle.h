// HDF5 identifiers that close themselves, and the few calls on them that the output needs. Failures throw
// nothing and print nothing: every call tells by its return value.
#pragma once

#include <hdf5.h>
#include <hdf5_hl.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace jawari::host::hdf5 {

class Handle {
  public:
    using Close = herr_t (*)(hid_t);
    Handle() = default;
    Handle(hid_t id, Close closer) : id_(id), close_(closer) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
    Handle& operator=(Handle&& other) noexcept {
        if (this != &other) {
            close();
            id_ = std::exchange(other.id_, H5I_INVALID_HID);
            close_ = other.close_;
        }
        return *this;
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() { close(); }

    [[nodiscard]] bool ok() const { return id_ >= 0; }
    [[nodiscard]] hid_t id() const { return id_; }
    /// False if HDF5 reports a failure. Closes once.
    bool close() {
        if (id_ < 0) return true;
        return close_(std::exchange(id_, H5I_INVALID_HID)) >= 0;
    }

  private:
    hid_t id_ = H5I_INVALID_HID;
    Close close_ = nullptr;
};

/// Turns off HDF5's printing of errors and its clean-up at exit, which fails noisily once a disk is full.
void quiet();

Handle create_file(const std::string& path);
Handle create_group(hid_t parent, const std::string& name);

/// Size of a dataset: rows x columns, or one dimension without columns. Zero columns are allowed.
struct Extent {
    std::uint64_t rows = 0;
    std::optional<std::size_t> columns;
};

/// A dataset of doubles, filled by write_rows().
Handle create_table(hid_t parent, const std::string& name, const Extent& extent, bool compressed);

/// `values`: row-major, block.rows x block.columns, from row `first` on.
bool write_rows(const Handle& table, std::uint64_t first, const Extent& block, const double* values);

Handle write_vector(hid_t parent, const std::string& name, const std::vector<double>& values);
Handle write_strings(hid_t parent, const std::string& name, const std::vector<std::string>& values);

/// A dimension of netCDF and xarray: the dataset gives it its name, its length and its coordinates.
bool make_scale(const Handle& dataset, const std::string& name);
/// One scale for each dimension of the dataset, in order.
bool attach_scales(const Handle& dataset, const std::vector<const Handle*>& scales);

bool set_attribute(hid_t object, const std::string& name, const std::string& value);
bool set_attribute(hid_t object, const std::string& name, double value);
bool set_attribute(hid_t object, const std::string& name, std::uint64_t value);

}  // namespace jawari::host::hdf5
